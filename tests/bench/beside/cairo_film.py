"""The film by Cairo and librsvg in Python: python3 cairo_film.py DRAWING FOLDER"""
import math
import sys

import cairo
import gi

gi.require_version("Rsvg", "2.0")
from gi.repository import Rsvg  # noqa: E402

COLOURS = ["#e4572e", "#f3a712", "#2e86ab"]


def rgb(code):
    return [int(code[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def load(path):
    handle = Rsvg.Handle.new_from_file(path)
    surface = cairo.ImageSurface(cairo.FORMAT_ARGB32, 320, 360)
    area = Rsvg.Rectangle()
    area.x, area.y, area.width, area.height = 0, 0, 320, 360
    handle.render_document(cairo.Context(surface), area)
    return surface


def draw(pen, frame, owl):
    sky = cairo.LinearGradient(0, 0, 0, 720)
    sky.add_color_stop_rgb(0, *rgb("#16202e"))
    sky.add_color_stop_rgb(1, *rgb("#7a5c74"))
    pen.set_source(sky)
    pen.paint()
    u = frame / 149
    for i in range(30):
        radius = 30 + 3 * i
        x = (1 - u) * (173 * i % 1280) + u * (311 * i % 1280)
        y = (1 - u) * (97 * i % 720) + u * ((59 * i + 300) % 720)
        light = cairo.RadialGradient(x, y, 0, x, y, radius)
        light.add_color_stop_rgb(0, *rgb("#fff4d6"))
        light.add_color_stop_rgb(1, *rgb(COLOURS[i % 3]))
        pen.set_source(light)
        pen.arc(x, y, radius, 0, 2 * math.pi)
        pen.fill()
    pen.set_source_surface(owl, 880, 330)
    pen.paint()
    pen.select_font_face("DejaVu Sans", cairo.FONT_SLANT_NORMAL, cairo.FONT_WEIGHT_BOLD)
    pen.set_font_size(96)
    pen.set_source_rgb(*rgb("#f6ead2"))
    pen.move_to(640 - pen.text_extents("Six seconds").x_advance / 2, 160)
    pen.show_text("Six seconds")
    pen.new_path()


def main(drawing, folder):
    owl = load(drawing)
    surface = cairo.ImageSurface(cairo.FORMAT_RGB24, 1280, 720)
    pen = cairo.Context(surface)
    for frame in range(150):
        draw(pen, frame, owl)
        surface.write_to_png(f"{folder}/{frame + 1:04}.png")


main(*sys.argv[1:])
