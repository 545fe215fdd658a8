"""The plugin of Krita with which tests/material/krita_keys.lua makes a painting that moves, and
writes what Krita shows of it. Krita's actions work on the layer that its window has chosen, so
events are handled after each step."""
import json
import os
import time
import traceback

from krita import Extension, Krita
from PyQt5.QtCore import QTimer
from PyQt5.QtWidgets import QApplication

SIZE = WIDTH, HEIGHT = 48, 32
LAST = 14  # frame
FOLDER = os.environ["CELSPAN_KRITA"]


def settle(document, seconds=0.2):
    """Handles events until Krita has nothing left to do; its windows follow with a delay."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        document.waitForDone()
        QApplication.processEvents()


def action(document, name, frame):
    document.setCurrentTime(frame)
    settle(document)
    Krita.instance().action(name).trigger()
    settle(document)


def paint(document, layer, box, colour):
    """Fills a box of a layer with a colour: blue, green, red, alpha."""
    pixels = bytearray(4 * WIDTH * HEIGHT)
    for y in range(box[1], box[1] + box[3]):
        for x in range(box[0], box[0] + box[2]):
            at = 4 * (WIDTH * y + x)
            pixels[at:at + 4] = bytes(colour)
    layer.setPixelData(bytes(pixels), 0, 0, WIDTH, HEIGHT)
    document.refreshProjection()
    settle(document)


def add(document, name):
    """Adds a layer as its user would: the new layer is the one that actions work on."""
    before = [layer.uniqueId() for layer in document.topLevelNodes()]
    Krita.instance().action("add_new_paint_layer").trigger()
    settle(document, 1)
    layer = next(one for one in document.topLevelNodes() if one.uniqueId() not in before)
    layer.setName(name)
    settle(document)
    return layer


def draw(document, layer, frame, box, colour):
    action(document, "add_blank_frame", frame)
    if box:
        paint(document, layer, box, colour)


def make(document):
    ball = document.topLevelNodes()[0]
    ball.setName("ball")
    for frame, left in ((0, 2), (3, 10), (7, 20)):
        draw(document, ball, frame, (left, 4, 8, 8), (30, 40 + 10 * left, 220, 255))
    draw(document, ball, 11, None, None)
    lamp = add(document, "lamp")
    draw(document, lamp, 2, (30, 18, 12, 10), (60, 220, 250, 255))
    draw(document, lamp, 9, (26, 16, 18, 14), (60, 220, 250, 255))
    for frame, opacity in ((2, 255), (6, 90), (12, 200)):
        action(document, "add_scalar_keyframes", frame)
        lamp.setOpacity(opacity)
        settle(document)
    ground = add(document, "ground")
    paint(document, ground, (0, 0, 4, HEIGHT), (180, 200, 210, 255))


def truth(document):
    """What Krita shows at points of each frame, as red, green, blue and alpha."""
    points = [(4, 6), (14, 6), (24, 6), (34, 20), (27, 17), (44, 2)]
    frames = []
    for frame in range(LAST + 1):
        document.setCurrentTime(frame)
        document.refreshProjection()
        settle(document)
        colours = []
        for x, y in points:
            code = bytes(document.pixelData(x, y, 1, 1))
            colours.append([code[2], code[1], code[0], code[3]])
        frames.append(colours)
    return {"points": points, "frames": frames}


def work():
    try:
        app = Krita.instance()
        document = app.createDocument(*SIZE, "keys", "RGBA", "U8", "sRGB-elle-V2-srgbtrc.icc", 72.0)
        app.activeWindow().addView(document)
        app.setActiveDocument(document)
        document.setBatchmode(True)
        document.setFramesPerSecond(12)
        document.setFullClipRangeStartTime(0)
        document.setFullClipRangeEndTime(LAST)
        make(document)
        with open(os.path.join(FOLDER, "krita_keys.json"), "w") as file:
            json.dump(truth(document), file)
        document.setCurrentTime(0)
        settle(document)
        document.saveAs(os.path.join(FOLDER, "krita_keys.kra"))
        settle(document)
    except Exception:
        traceback.print_exc()
    os._exit(0)


class Keys(Extension):
    def setup(self):
        QTimer.singleShot(8000, work)

    def createActions(self, window):
        pass


Krita.instance().addExtension(Keys(Krita.instance()))
