"""The raw frames of the film by Cairo in Python: python3 simple_cairo.py FRAMES"""
import math
import sys

import cairo

COLOURS = ["#e4572e", "#f3a712", "#2e86ab"]


def rgb(code):
    return [int(code[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def vertical(top, foot):
    down = cairo.LinearGradient(0, 0, 0, 720)
    down.add_color_stop_rgb(0, *rgb(top))
    down.add_color_stop_rgb(1, *rgb(foot))
    return down


def draw_background(pen):
    pen.set_source(vertical("#16202e", "#7a5c74"))
    pen.paint()
    pen.set_source(vertical("#3d5a6c", "#16202e"))
    for i in range(5):
        pen.move_to(0, 720)
        for x in range(0, 1281, 16):
            pen.line_to(x, 420 + 60 * i + 40 * math.sin(x / (90 + 30 * i) + 2 * i))
        pen.line_to(1280, 720)
        pen.fill()


def draw(pen, frame):
    draw_background(pen)
    u = frame / 149
    for i in range(30):
        radius = 30 + 3 * i
        x = (1 - u) * (173 * i % 1280) + u * (311 * i % 1280)
        y = (1 - u) * (97 * i % 720) + u * ((59 * i + 300) % 720)
        light = cairo.RadialGradient(x, y, 0, x, y, radius)
        light.add_color_stop_rgba(0, *rgb("#fff4d6"), 0.9)
        light.add_color_stop_rgba(1, *rgb(COLOURS[i % 3]), 0.9)
        pen.set_source(light)
        pen.arc(x, y, radius, 0, 2 * math.pi)
        pen.fill()
    pen.select_font_face("DejaVu Sans", cairo.FONT_SLANT_NORMAL, cairo.FONT_WEIGHT_BOLD)
    pen.set_font_size(96)
    pen.set_source_rgb(*rgb("#f6ead2"))
    pen.move_to(640 - pen.text_extents("Six seconds").x_advance / 2, 160)
    pen.show_text("Six seconds")
    pen.new_path()


def main(frames):
    surface = cairo.ImageSurface(cairo.FORMAT_RGB24, 1280, 720)
    pen = cairo.Context(surface)
    for frame in range(int(frames)):
        draw(pen, frame)
        surface.flush()
        sys.stdout.buffer.write(surface.get_data())


main(*sys.argv[1:])
