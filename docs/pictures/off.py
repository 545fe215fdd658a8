"""Prints how far two films are apart: the mean difference of codes, 0 to 255, in the square of 32
pixels in which it is largest, and in which frame. A mean over the whole picture would hide a ghost.

    python3 off.py FILM FILM FPS

A FILM is an animated WebP, a movie that ffmpeg reads, or pictures such as film.%04d.png: frames
without a picture are not compared. Their lengths must be the same."""
import itertools
import os
import re
import subprocess
import sys
from PIL import Image, ImageChops

SQUARE = 32


def size_of(path):
    return subprocess.check_output(["ffprobe", "-v", "error", "-select_streams", "v",
        "-show_entries", "stream=width,height", "-of", "csv=p=0:s=x", path], text=True).split("x")


def frames(path, fps):
    """Yields the picture of each frame, or None."""
    if path.endswith(".webp"):
        film = Image.open(path)
        for i in range(film.n_frames):
            film.seek(i)
            film.load()
            times = round(film.info["duration"] * fps / 1000)
            yield from itertools.repeat(film.convert("RGBA"), times)
    elif "%" in path:
        names = sorted(os.listdir(os.path.dirname(path)))
        for number in range(1, int(re.findall(r"\d+", names[-1])[-1]) + 1):
            is_there = os.path.exists(path % number)
            yield Image.open(path % number).convert("RGBA") if is_there else None
    else:
        size = tuple(map(int, size_of(path)))
        decoder = subprocess.Popen(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo",
            "-pix_fmt", "rgba", "-"], stdout=subprocess.PIPE)
        while pixels := decoder.stdout.read(size[0] * size[1] * 4):
            yield Image.frombytes("RGBA", size, pixels)
        if decoder.wait():
            sys.exit(f"{path}: ffmpeg cannot read it")


def off(a, b):
    """The mean difference in the square in which it is largest, over grey."""
    grey = Image.new("RGBA", a.size, "grey")
    a, b = (Image.alpha_composite(grey, one).convert("RGB") for one in (a, b))
    squares = tuple(-(-side // SQUARE) for side in a.size)
    means = ImageChops.difference(a, b).resize(squares, Image.BOX)
    return max(most for _, most in means.getextrema())


def main(first, second, fps):
    worst, count = (0, 0), 0
    for a, b in itertools.zip_longest(frames(first, fps), frames(second, fps), fillvalue=False):
        count += 1
        if a is False or b is False or a and b and a.size != b.size:
            sys.exit(f"frame {count}: another length or size")
        if a and b:
            worst = max(worst, (off(a, b), count))
    if count == 0:
        sys.exit("neither has a frame")
    print(*worst)


main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
