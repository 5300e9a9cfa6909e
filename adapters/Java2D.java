// Java 2D without antialiasing: Graphics2D.fill(Path2D.Double) with STROKE_PURE, or, with `polygon` as the
// first argument, Graphics2D.fillPolygon(int[], int[], 3). Lines: Graphics2D.drawLine(int, int, int, int).
//
// java.awt.Shape: a point on the outline is inside if what lies directly right of it is or, on a horizontal
// outline, what lies directly below it: top-left, as is assumed where nothing is declared.
import java.awt.*;
import java.awt.geom.Path2D;
import java.awt.image.*;
import java.io.*;
import java.nio.charset.StandardCharsets;

public class Java2D {
    static final int MOST_SIDE = 1024, MOST_BYTES = 65536;
    static boolean whole;
    static BufferedImage image;
    static Graphics2D graphics;

    static void begin(int width, int height) {
        if (image == null || image.getWidth() != width || image.getHeight() != height) {
            image = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
            graphics = image.createGraphics();
            graphics.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_OFF);
            if (!whole) graphics.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE);
        }
        graphics.setColor(Color.BLACK);
        graphics.fillRect(0, 0, width, height);
        graphics.setColor(Color.WHITE);
    }

    static void triangle(double[] v) {
        if (whole) {
            graphics.fillPolygon(new int[] {(int) v[0], (int) v[2], (int) v[4]},
                                 new int[] {(int) v[1], (int) v[3], (int) v[5]}, 3);
            return;
        }
        Path2D.Double path = new Path2D.Double();
        path.moveTo(v[0], v[1]);
        path.lineTo(v[2], v[3]);
        path.lineTo(v[4], v[5]);
        path.closePath();
        graphics.fill(path);
    }

    static String answer(String[] words) {
        String id = words.length > 1 ? words[1] : "-";
        if (words[0].equals("HELLO")) {
            String version = System.getProperty("java.version");
            String known = " java2d-" + version + (whole ? "-polygon" : "-path") + " coverage line";
            if (words.length == 2 && id.equals("1")) return "HELLO 1" + known;
            if (words.length != 2 || !id.equals("2")) return "E - say HELLO 1 or HELLO 2";
            String declared = (whole ? " grid=1" : "") + " mask line-set batch=64";
            return "HELLO 2" + known + " window=" + MOST_SIDE + "x" + MOST_SIDE + declared;
        }
        boolean isLine = words[0].equals("L");
        int n = isLine ? 4 : 6;
        if (!isLine && !words[0].equals("T")) return "E " + id + " unsupported";
        if (words.length != n + 4) return "E " + id + " " + words[0] + " takes id width height and " + n + " numbers";
        double[] v = new double[n + 2];
        for (int i = 0; i < v.length; i++) {
            try {
                v[i] = Double.parseDouble(words[2 + i]);
            } catch (NumberFormatException notANumber) {
                v[i] = Double.NaN;
            }
        }
        int width = (int) v[0], height = (int) v[1];
        if (v[0] != width || v[1] != height || width < 1 || height < 1 || width > MOST_SIDE || height > MOST_SIDE) {
            return "E " + id + " the window must be from 1x1 to " + MOST_SIDE + "x" + MOST_SIDE;
        }
        v = java.util.Arrays.copyOfRange(v, 2, v.length);
        for (double value : v) {
            if (!(value >= -0x1p31 && value < 0x1p31)) {
                return "E " + id + " a coordinate is not a number within 2^31 px";
            }
            if (whole && value != Math.floor(value)) return "E " + id + " unsupported: off the declared grid";
        }
        begin(width, height);
        if (isLine) {
            int[] p = java.util.Arrays.stream(v).mapToInt(value -> (int) Math.floor(value)).toArray();
            graphics.drawLine(p[0], p[1], p[2], p[3]);
        } else {
            triangle(v);
        }
        return (isLine ? "P " : "C ") + id + " " + (isLine ? pixels() : runs());
    }

    static boolean isDrawn(int x, int y) {
        int[] pixels = ((DataBufferInt) image.getRaster().getDataBuffer()).getData();
        return (pixels[y * image.getWidth() + x] & 0xffffff) != 0;
    }

    static String runs() {
        StringBuilder text = new StringBuilder();
        int n = 0, width = image.getWidth();
        for (int y = 0; y < image.getHeight(); y++) {
            for (int x = 0, end; x < width; x = end) {
                for (end = x; end < width && isDrawn(end, y);) end++;
                if (end > x) {
                    text.append(' ').append(y).append(' ').append(x).append(' ').append(end);
                    n++;
                } else {
                    end = x + 1;
                }
            }
        }
        return n + text.toString();
    }

    static String pixels() {
        StringBuilder text = new StringBuilder();
        int n = 0;
        for (int y = 0; y < image.getHeight(); y++) {
            for (int x = 0; x < image.getWidth(); x++) {
                if (!isDrawn(x, y)) continue;
                text.append(' ').append(x).append(' ').append(y);
                n++;
            }
        }
        return n + text.toString();
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
        whole = args.length > 0 && args[0].equals("polygon");
        System.setProperty("java.awt.headless", "true");
        FileOutputStream output = new FileOutputStream(FileDescriptor.out);
        PrintStream protocol = new PrintStream(new BufferedOutputStream(output), false, StandardCharsets.ISO_8859_1);
        System.setOut(System.err);
        InputStream in = new BufferedInputStream(System.in);
        for (String line; (line = read(in)) != null;) {
            String[] words = line.replaceAll("^[ \t\r\u000b\f]+", "").split("[ \t\r\u000b\f]+");
            if (words[0].isEmpty()) continue;
            String reply;
            try {
                boolean tooLong = line.length() > MOST_BYTES;
                reply = tooLong ? "E - a request has at most " + MOST_BYTES + " bytes" : answer(words);
            } catch (RuntimeException error) {
                error.printStackTrace();
                reply = "E " + (words.length > 1 ? words[1] : "-") + " raised " + error.getClass().getSimpleName();
            }
            protocol.print(reply + "\n");
            protocol.flush();
        }
    }
}
