// 1. Put your code into triangle() and line() below; set HAS_LINES to false if you draw no lines.
// 2. Say in DECLARES what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
// 3. Judge it: rasterproof judge -- java Starter.java
import java.io.*;
import java.nio.charset.StandardCharsets;
import java.util.*;

public class Starter {
    static final String NAME = "mine";
    static final String DECLARES = "batch=64";
    static final boolean HAS_LINES = true;

    interface SetPixel {
        void at(int x, int y);
    }

    // ---- YOUR PLACE: replace the bodies of these two functions ----

    static double side(double ax, double ay, double bx, double by, double x, double y) {
        return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    }

    /** Corners in pixels, y down; setPixel.at(x, y) for every pixel drawn. As it stands it draws every sample
     *  on an edge, so two neighbours both draw the edge they share. */
    static void triangle(double x0, double y0, double x1, double y1, double x2, double y2, int width, int height,
                         SetPixel setPixel) {
        int left = (int) Math.max(0, Math.floor(Math.min(x0, Math.min(x1, x2))));
        int right = (int) Math.min(width, Math.ceil(Math.max(x0, Math.max(x1, x2))));
        int top = (int) Math.max(0, Math.floor(Math.min(y0, Math.min(y1, y2))));
        int bottom = (int) Math.min(height, Math.ceil(Math.max(y0, Math.max(y1, y2))));
        for (int y = top; y < bottom; y++) {
            for (int x = left; x < right; x++) {
                double e0 = side(x0, y0, x1, y1, x + 0.5, y + 0.5);
                double e1 = side(x1, y1, x2, y2, x + 0.5, y + 0.5);
                double e2 = side(x2, y2, x0, y0, x + 0.5, y + 0.5);
                if ((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)) setPixel.at(x, y);
            }
        }
    }

    /** From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA. */
    static void line(int x0, int y0, int x1, int y1, int width, int height, SetPixel setPixel) {
        double dx = (double) x1 - x0, dy = (double) y1 - y0, steps = Math.max(Math.abs(dx), Math.abs(dy));
        // Of the longer direction, only the steps inside the window.
        boolean alongX = Math.abs(dx) >= Math.abs(dy), forwards = (alongX ? dx : dy) >= 0;
        double start = alongX ? x0 : y0, size = alongX ? width : height;
        double first = Math.max(0, forwards ? -start : start - size + 1);
        double last = Math.min(steps, forwards ? size - 1 - start : start);
        for (double i = first; i <= last; i++) {
            setPixel.at((int) Math.floor(x0 + dx * i / Math.max(steps, 1) + 0.5),
                        (int) Math.floor(y0 + dy * i / Math.max(steps, 1) + 0.5));
        }
    }

    // ---- the line protocol: nothing to change from here on ----

    static final int MOST_BYTES = 65536, MOST_SIDE = 1024, MOST_HITS = 1 << 22;

    static class Refused extends RuntimeException {
        Refused(String reason) {
            super(reason);
        }
    }

    /** The pixels drawn for one request, as y * MOST_SIDE + x. */
    static int[] hits = new int[4096];
    static int count;

    static SetPixel into(int width, int height) {
        count = 0;
        return (x, y) -> {
            if (x < 0 || y < 0 || x >= width || y >= height) return;
            if (count == MOST_HITS) throw new Refused("more than " + MOST_HITS + " pixels set");
            if (count == hits.length) hits = Arrays.copyOf(hits, 2 * count);
            hits[count++] = y * MOST_SIDE + x;
        };
    }

    /** Row, first column, one past the last; a pixel hit twice is in two runs. */
    static String runs() {
        Arrays.sort(hits, 0, count);
        StringBuilder text = new StringBuilder();
        int n = 0;
        for (int i = 0, end; i < count; i = end, n++) {
            int y = hits[i] / MOST_SIDE, x = hits[i] % MOST_SIDE;
            for (end = i + 1; end < count && hits[end] == hits[end - 1] + 1 && hits[end] / MOST_SIDE == y;) end++;
            text.append(' ').append(y).append(' ').append(x).append(' ').append(x + end - i);
        }
        return n + text.toString();
    }

    static String pixels() {
        StringBuilder text = new StringBuilder().append(count);
        for (int i = 0; i < count; i++) {
            text.append(' ').append(hits[i] % MOST_SIDE).append(' ').append(hits[i] / MOST_SIDE);
        }
        return text.toString();
    }

    /** A decimal number or a C99 hex float. */
    static double number(String word) {
        double value = Double.NaN;
        try {
            boolean lacksExponent = word.matches("(?i)[+-]?0x[^p]*");
            value = Double.parseDouble(lacksExponent ? word + "p0" : word);
        } catch (NumberFormatException notANumber) {
            // Stays NaN, which is refused below.
        }
        if (!(value >= -0x1p31 && value < 0x1p31)) {
            throw new Refused("a coordinate is not a number within 2^31 px");
        }
        return value;
    }

    static int windowSide(String word) {
        int side = word.matches("[0-9]{1,8}") ? Integer.parseInt(word) : 0;
        if (side < 1 || side > MOST_SIDE) {
            throw new Refused("the window must be from 1x1 to " + MOST_SIDE + "x" + MOST_SIDE);
        }
        return side;
    }

    static String draw(String[] words) {
        String verb = words[0];
        int n = verb.equals("T") ? 6 : 4;
        if (words.length != n + 4) throw new Refused(verb + " takes id width height and " + n + " numbers");
        int width = windowSide(words[2]), height = windowSide(words[3]);
        double[] v = new double[n];
        for (int i = 0; i < v.length; i++) v[i] = number(words[4 + i]);
        SetPixel setPixel = into(width, height);
        if (verb.equals("T")) {
            triangle(v[0], v[1], v[2], v[3], v[4], v[5], width, height, setPixel);
            return "C " + words[1] + " " + runs();
        }
        line((int) Math.floor(v[0]), (int) Math.floor(v[1]), (int) Math.floor(v[2]), (int) Math.floor(v[3]),
             width, height, setPixel);
        return "P " + words[1] + " " + pixels();
    }

    static String answer(String[] words) {
        String id = words.length > 1 ? words[1] : "-";
        if (words[0].equals("HELLO")) {
            String known = " " + NAME + " coverage" + (HAS_LINES ? " line" : "");
            if (words.length == 2 && id.equals("1")) return "HELLO 1" + known;
            if (words.length != 2 || !id.equals("2")) return "E - say HELLO 1 or HELLO 2";
            return "HELLO 2" + known + " window=" + MOST_SIDE + "x" + MOST_SIDE + " " + DECLARES;
        }
        if (!(words[0].equals("T") || HAS_LINES && words[0].equals("L"))) return "E " + id + " unsupported";
        try {
            return draw(words);
        } catch (Refused refused) {
            return "E " + id + " " + refused.getMessage();
        } catch (RuntimeException | StackOverflowError error) {
            error.printStackTrace();
            return "E " + id + " raised " + error.getClass().getSimpleName();
        }
    }

    /** A line without its end, or null at the end of the input; of a longer one only that it is too long. */
    static String read(InputStream in) throws IOException {
        ByteArrayOutputStream line = new ByteArrayOutputStream();
        int c, length = 0;
        while ((c = in.read()) >= 0 && c != '\n') {
            if (++length <= MOST_BYTES + 1) line.write(c);
        }
        return c < 0 && length == 0 ? null : line.toString(StandardCharsets.ISO_8859_1);
    }

    public static void main(String[] args) throws IOException {
        FileOutputStream output = new FileOutputStream(FileDescriptor.out);
        PrintStream protocol = new PrintStream(new BufferedOutputStream(output), false, StandardCharsets.ISO_8859_1);
        System.setOut(System.err); // what your code prints
        InputStream in = new BufferedInputStream(System.in);
        for (String line; (line = read(in)) != null;) {
            String[] words = line.replaceAll("^[ \t\r\u000b\f]+", "").split("[ \t\r\u000b\f]+");
            boolean tooLong = line.length() > MOST_BYTES;
            if (!tooLong && words[0].isEmpty()) continue;
            String reply = tooLong ? "E - a request has at most " + MOST_BYTES + " bytes" : answer(words);
            protocol.print(reply + "\n");
            protocol.flush();
        }
    }
}
