import com.google.gson.JsonElement;
import com.google.gson.JsonObject;
import com.google.gson.JsonParser;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.DoubleBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import org.locationtech.jts.JTSVersion;
import org.locationtech.jts.algorithm.hull.ConcaveHull;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.MultiPoint;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.io.ByteOrderValues;
import org.locationtech.jts.io.WKBWriter;

/** JTS's concave hull as a worker of hullbench (adapters/process/PROTOCOL.md). */
public class JtsConcaveHull {
  private static final GeometryFactory FACTORY = new GeometryFactory();

  /** For methods that recurse; by default a thread has 1 MiB. Memory is used only as far as the stack grows. */
  private static final long STACK_BYTES = 256L << 20;

  /** So much may be left. It is a seventeenth of the room for new objects in a heap of 1 GiB (-Xms), and hardly matters. */
  private static final long MOST_GARBAGE_BYTES = 16L << 20;

  private MultiPoint points;

  /** The least that the heap held before a run since the last collection: what is in use, and maybe more. */
  private long liveBytes = 0;

  public static void main(String[] arguments) {
    PrintStream replies = System.out;
    System.setOut(System.err);
    Thread worker = new Thread(null, () -> answerAll(replies), "worker", STACK_BYTES);
    worker.setUncaughtExceptionHandler(
        (thread, error) -> {
          error.printStackTrace();
          System.exit(1);
        });
    worker.start();
  }

  private static void answerAll(PrintStream replies) {
    JtsConcaveHull worker = new JtsConcaveHull();
    BufferedReader requests = new BufferedReader(new InputStreamReader(System.in));
    requests
        .lines()
        .map(line -> JsonParser.parseString(line).getAsJsonObject())
        .takeWhile(request -> !request.get("request").getAsString().equals("quit"))
        .forEach(
            request -> {
              replies.println(worker.answer(request));
              replies.flush();
            });
  }

  private JsonObject answer(JsonObject request) {
    try {
      switch (request.get("request").getAsString()) {
        case "hello":
          return hello();
        case "load":
          return load(request);
        default:
          return run(request);
      }
    } catch (OutOfMemoryError error) {
      return failure("memory", "the Java heap is full");
    } catch (StackOverflowError error) {
      return failure("error", "the stack of " + (STACK_BYTES >> 20) + " MiB is full");
    } catch (IllegalArgumentException error) {
      return failure("invalid_argument", String.valueOf(error.getMessage()));
    } catch (Exception error) {
      return failure("error", error.toString());
    }
  }

  private static JsonObject hello() {
    JsonObject reply = new JsonObject();
    reply.addProperty("protocol", 1);
    reply.addProperty("version", JTSVersion.CURRENT_VERSION.toString());
    return reply;
  }

  private JsonObject load(JsonObject request) throws IOException {
    Coordinate[] coordinates = readPoints(request);
    long begin = System.nanoTime();
    points = FACTORY.createMultiPointFromCoords(coordinates);
    return times("load", System.nanoTime() - begin);
  }

  private JsonObject run(JsonObject request) throws IOException {
    JsonObject parameters = request.getAsJsonObject("parameters");
    boolean holes = parameters.get("allow_holes").getAsDouble() != 0;
    // JSON has no infinity: a length without a limit is null.
    JsonElement length = parameters.get("max_edge_length");
    collectGarbage();
    long begin = System.nanoTime();
    Geometry hull =
        length.isJsonNull()
            ? ConcaveHull.concaveHullByLengthRatio(points, parameters.get("length_ratio").getAsDouble(), holes)
            : ConcaveHull.concaveHullByLength(points, length.getAsDouble(), holes);
    long runNanoseconds = System.nanoTime() - begin;
    // What has no area comes as a point or a line.
    begin = System.nanoTime();
    Polygon[] polygons = hull instanceof Polygon ? new Polygon[] {(Polygon) hull} : new Polygon[0];
    Geometry shape = FACTORY.createMultiPolygon(polygons);
    long extractNanoseconds = System.nanoTime() - begin;
    Files.write(
        Path.of(request.get("result").getAsString()),
        new WKBWriter(2, ByteOrderValues.LITTLE_ENDIAN).write(shape));
    JsonObject reply = times("run", runNanoseconds);
    reply.getAsJsonObject("phases_ns").addProperty("extract", extractNanoseconds);
    reply.add("nonce", request.get("nonce"));
    return reply;
  }

  /**
   * So that no run pays for what earlier ones left; what a run leaves and Java collects meanwhile is its own time. A
   * collection takes some 12 ms, however little there is to collect: so many short runs share one.
   */
  private void collectGarbage() {
    // Java may have collected in the last run, and with it points of an earlier load.
    liveBytes = Math.min(liveBytes, usedBytes());
    if (usedBytes() - liveBytes < MOST_GARBAGE_BYTES) return;
    System.gc();
    liveBytes = usedBytes();
  }

  private static long usedBytes() {
    return Runtime.getRuntime().totalMemory() - Runtime.getRuntime().freeMemory();
  }

  private static Coordinate[] readPoints(JsonObject request) throws IOException {
    DoubleBuffer values =
        ByteBuffer.wrap(Files.readAllBytes(Path.of(request.get("points").getAsString())))
            .order(ByteOrder.LITTLE_ENDIAN)
            .asDoubleBuffer();
    Coordinate[] coordinates = new Coordinate[request.get("n").getAsInt()];
    if (values.remaining() != 2 * coordinates.length) throw new IOException("the file of points has another size");
    for (int i = 0; i < coordinates.length; ++i) {
      coordinates[i] = new Coordinate(values.get(2 * i), values.get(2 * i + 1));
      if (!coordinates[i].isValid()) throw new IllegalArgumentException("point " + i + " is not finite");
    }
    return coordinates;
  }

  private static JsonObject times(String phase, long nanoseconds) {
    JsonObject phases = new JsonObject();
    phases.addProperty(phase, nanoseconds);
    JsonObject reply = new JsonObject();
    reply.add("phases_ns", phases);
    return reply;
  }

  private static JsonObject failure(String kind, String message) {
    JsonObject error = new JsonObject();
    error.addProperty("kind", kind);
    error.addProperty("message", message);
    JsonObject reply = new JsonObject();
    reply.add("error", error);
    return reply;
  }
}
