"""Fills triangles by Skia or Blend2D for the comparison, which starts it: fills.py Skia|Blend2D centres|smooth CLASSES

    fill CLASS FROM TO               fills these triangles twice; the answer is the nanoseconds of the second time
    take CLASS NUMBER X0 Y0 X1 Y1    fills one triangle; the answer is the alpha of each pixel there, which is then empty
    left                             the pixels that are not empty, which then are

Paths are made before anything is timed. Skia plays back a picture of them, so that a turn is one call. Blend2D's package has nothing
like it and is called once for each triangle.
"""

import json
import sys
import time

SIDE = 1024
RED, GREEN, BLUE = 0x90, 0x60, 0x30


class Skia:
    def __init__(self, smooth):
        import numpy
        import skia

        self.skia, self.version = skia, f"Skia {skia.__version__.partition('.')[0]} (skia-python {skia.__version__})"
        self.paint = skia.Paint(Color=skia.Color(RED, GREEN, BLUE), AntiAlias=smooth)
        self.pixels = numpy.zeros((SIDE, SIDE, 4), numpy.uint8)
        self.surface = skia.Surface(self.pixels)
        self.canvas = self.surface.getCanvas()
        self.pictures = {}

    def path(self, corners):
        path = self.skia.Path()
        path.moveTo(*corners[:2])
        path.lineTo(*corners[2:4])
        path.lineTo(*corners[4:])
        path.close()
        return path

    def turn(self, key, paths):
        """What fills these paths when it is called."""
        picture = self.pictures.get(key)
        if picture is None:
            recorder = self.skia.PictureRecorder()
            canvas = recorder.beginRecording(self.skia.Rect(SIDE, SIDE))
            for path in paths:
                canvas.drawPath(path, self.paint)
            picture = recorder.finishRecordingAsPicture()
            # A turn comes again in the next round, a triangle of its own does not.
            if len(paths) > 1:
                self.pictures[key] = picture
        return lambda: self.canvas.drawPicture(picture)


class Blend2D:
    def __init__(self, smooth):
        import blend2d

        if not smooth:
            sys.exit(print("Blend2D always antialiases"))
        from importlib.metadata import version

        self.blend2d, self.version = blend2d, f"Blend2D (blend2d-py {version('blend2d-py')})"
        self.image = blend2d.Image(SIDE, SIDE)
        self.pixels = self.image.asarray()
        self.context = blend2d.Context(self.image)
        self.context.set_fill_style_rgba(RED, GREEN, BLUE, 255)
        self.pixels[:] = 0

    def path(self, corners):
        path = self.blend2d.Path()
        path.move_to(*corners[:2])
        path.line_to(*corners[2:4])
        path.line_to(*corners[4:])
        path.close()
        return path

    def turn(self, key, paths):
        fill = self.context.fill_path

        def draw():
            for path in paths:
                fill(path)

        return draw


def main():
    library, quality, file = sys.argv[1:]
    try:
        renderer = {"Skia": Skia, "Blend2D": Blend2D}[library](quality == "smooth")
    except ImportError as error:
        sys.exit(print(error))
    classes = {name: [renderer.path(corners) for corners in all] for name, all in json.load(open(file)).items()}
    print("ready", renderer.version, flush=True)
    answer, pixels = sys.stdout.buffer, renderer.pixels
    for line in sys.stdin:
        word, *words = line.split()
        if word == "fill":
            name, start, end = words[0], int(words[1]), int(words[2])
            turn = renderer.turn((name, start), classes[name][start:end])
            turn()
            begin = time.perf_counter_ns()
            turn()
            answer.write(b"%d\n" % (time.perf_counter_ns() - begin))
        elif word == "take":
            number, x0, y0, x1, y1 = map(int, words[1:])
            renderer.turn(None, classes[words[0]][number : number + 1])()
            answer.write(pixels[y0:y1, x0:x1, 3].tobytes())
            pixels[y0:y1, x0:x1] = 0
        elif word == "left":
            answer.write(b"%d\n" % (pixels[:, :, 3] != 0).sum())
            pixels[:] = 0
        answer.flush()


main()
