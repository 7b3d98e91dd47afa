// The pages of the site: light and dark, and the search, whose index is in every page.
import { readJson } from "./data.js";
import { make, wordsOf } from "./format.js";
import { startTheme } from "./theme.js";

const MOST_FOUND = 12;

/** The pages that have every word, those first whose title begins with the first one. */
function find(pages, words) {
  const wanted = wordsOf(words);
  if (!wanted.length) return [];
  const late = (page) => !page.title.toLowerCase().startsWith(wanted[0]);
  return pages.filter((page) => wanted.every((word) => page.text.includes(word))).sort((a, b) => late(a) - late(b));
}

function startSearch() {
  const pages = readJson("pages").map(([title, kind, address, words]) => {
    return { title, kind, address, text: `${title} ${kind} ${words}`.toLowerCase() };
  });
  const [box, input, said, list] = ["search", "search-words", "search-said", "search-found"].map((id) =>
    document.getElementById(id),
  );
  box.hidden = false;

  input.addEventListener("input", () => {
    const found = find(pages, input.value);
    const more = found.length > MOST_FOUND ? `, of which ${MOST_FOUND} are shown` : "";
    said.textContent = input.value.trim() && (found.length === 1 ? "1 page" : `${found.length} pages${more}`);
    const links = found.slice(0, MOST_FOUND).map(({ title, kind, address }) => {
      return make("li", {}, make("a", { href: address }, title, " ", make("small", {}, kind)));
    });
    list.replaceChildren(...links);
  });

  box.addEventListener("keydown", (event) => {
    const links = [...list.querySelectorAll("a")];
    const place = links.indexOf(document.activeElement);
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Enter" && place < 0) links[0]?.click();
    else if (event.key === "Escape") {
      input.value = "";
      input.dispatchEvent(new Event("input"));
      input.focus();
    } else if (step) {
      (links[place + step] ?? input).focus();
      event.preventDefault();
    }
  });
}

startTheme();
startSearch();
