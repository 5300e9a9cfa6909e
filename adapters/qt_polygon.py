"""Qt: QPainter.drawPolygon without a pen, drawLine with one of width 1, both without antialiasing (PySide6)."""

import os

os.environ["QT_QPA_PLATFORM"] = "offscreen"

import numpy
import PySide6
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QImage, QPainter, QPolygonF
from rasterproof import serve


def drawn(width, height, draw):
    image = QImage(width, height, QImage.Format_RGB32)
    image.fill(0)
    painter = QPainter(image)
    painter.setPen(Qt.white)
    painter.setBrush(Qt.white)
    draw(painter)
    painter.end()
    return numpy.frombuffer(image.constBits(), numpy.uint32).reshape(height, width) & 0xFFFFFF


def triangle(points, width, height):
    def draw(painter):
        painter.setPen(Qt.NoPen)
        painter.drawPolygon(QPolygonF([QPointF(*point) for point in points]))

    return drawn(width, height, draw)


def line(points, width, height):
    return drawn(width, height, lambda painter: painter.drawLine(*points[0], *points[1]))


serve(f"qt-{PySide6.__version__}", "mask line-set batch=64", triangle, line)
