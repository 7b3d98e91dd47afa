// What 'hullbench league --all-cases --csv' writes of the invented run of tests/invented_run.cpp.

/** Of its report, as text. */
export function cases_csv(report) {
  const times = new Map(report.summary.rows.map((row) => [row.id, row.time]));
  const lines = ["method,task,fold,error,time,points,status,shape,kind,sampler,weight"];
  for (const run of report.runs.filter(({ status }) => status !== "not_installed")) {
    const ok = run.status === "ok";
    const time = ok ? times.get(run.id).median_ns / 1e9 : "";
    const kind = run.holes ? "holes" : "simple";
    const facts = [ok ? run.metrics.l2 : "inf", time, run.n, run.status, run.dataset, kind, "uniform", 1];
    const case_name = run.name.split("/").slice(1, -1).join("/");
    lines.push([`${run.method}/${run.protocol}`, case_name, run.seed, ...facts].join(","));
  }
  return `${lines.join("\n")}\n`;
}
