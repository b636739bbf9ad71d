"""Pictures of the explorer in a real terminal (tmux), drawn cell by cell.

    pip install pillow
    python3 tests/screenshots/explorer.py target/release/asperity assets/screenshots

Needs tmux and DejaVu Sans Mono. Each picture is what `tmux capture-pane -e` has on its screen: half blocks
and Braille are drawn as the dots that they are, all else in the font.
"""

import argparse
import pathlib
import re
import subprocess
import tempfile
import time

from PIL import Image, ImageDraw, ImageFont

CELL = (8, 17)
FONTS = ["/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "DejaVuSansMono.ttf"]
BACK, FORE = (16, 18, 24), (222, 226, 232)
BASIC = [
    (0, 0, 0), (205, 60, 60), (60, 180, 75), (210, 180, 60), (70, 110, 230), (190, 90, 190), (60, 180, 190), (220, 220, 220),
    (110, 110, 110), (255, 90, 90), (90, 230, 110), (255, 230, 90), (110, 150, 255), (240, 130, 240), (100, 230, 240), (255, 255, 255),
]
SOCKET = "asperity-screenshots"


def tmux(*arguments):
    done = subprocess.run(["tmux", "-L", SOCKET, "-f", "/dev/null", *arguments], check=True, capture_output=True, text=True)
    return done.stdout


def indexed(n):
    if n < 16:
        return BASIC[n]
    if n < 232:
        n -= 16
        return tuple(0 if v == 0 else 55 + 40 * v for v in (n // 36, n // 6 % 6, n % 6))
    return (8 + 10 * (n - 232),) * 3


class Pen:
    """The state that SGR sequences set."""

    def __init__(self):
        self.reset()

    def reset(self):
        self.fore, self.back, self.bold, self.dim, self.reverse = None, None, False, False, False

    def take(self, codes):
        codes = [int(code or 0) for code in codes]
        while codes:
            code = codes.pop(0)
            if code == 0:
                self.reset()
            elif code in (1, 2, 7):
                setattr(self, {1: "bold", 2: "dim", 7: "reverse"}[code], True)
            elif code == 22:
                self.bold = self.dim = False
            elif code == 27:
                self.reverse = False
            elif code in (38, 48):
                kind = codes.pop(0)
                color = indexed(codes.pop(0)) if kind == 5 else tuple(codes.pop(0) for _ in range(3))
                setattr(self, "fore" if code == 38 else "back", color)
            elif code == 39:
                self.fore = None
            elif code == 49:
                self.back = None
            elif 30 <= code <= 37 or 90 <= code <= 97:
                self.fore = BASIC[code - 30 if code < 90 else code - 82]
            elif 40 <= code <= 47:
                self.back = BASIC[code - 40]

    def colors(self):
        fore, back = self.fore or FORE, self.back or BACK
        if self.dim:
            fore = tuple((2 * f + b) // 3 for f, b in zip(fore, back))
        return (back, fore) if self.reverse else (fore, back)


def draw(text, size):
    columns, rows = size
    width, height = CELL
    image = Image.new("RGB", (columns * width, rows * height), BACK)
    canvas = ImageDraw.Draw(image)
    for name in FONTS:
        try:
            font = ImageFont.truetype(name, 13)
            break
        except OSError:
            continue
    else:
        raise SystemExit("DejaVu Sans Mono is not installed")
    pen = Pen()
    for row, line in enumerate(text.split("\n")[:rows]):
        column = 0
        for part in re.split(r"(\x1b\[[0-9;]*m)", line):
            if part.startswith("\x1b["):
                pen.take(part[2:-1].split(";"))
                continue
            for letter in part:
                cell(canvas, font, pen, letter, column * width, row * height)
                column += 1
    return image


def cell(canvas, font, pen, letter, x, y):
    width, height = CELL
    fore, back = pen.colors()
    canvas.rectangle((x, y, x + width - 1, y + height - 1), fill=back)
    code = ord(letter)
    if letter == "▀":
        canvas.rectangle((x, y, x + width - 1, y + height // 2 - 1), fill=fore)
    elif letter == "▄":
        canvas.rectangle((x, y + height // 2, x + width - 1, y + height - 1), fill=fore)
    elif letter == "█":
        canvas.rectangle((x, y, x + width - 1, y + height - 1), fill=fore)
    elif 0x2800 <= code < 0x2900:
        for bit, (column, row) in enumerate([(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)]):
            if (code - 0x2800) >> bit & 1:
                left, top = x + 1 + 4 * column, y + 1 + 4 * row
                canvas.rectangle((left, top, left + 1, top + 1), fill=fore)
    elif letter != " ":
        canvas.text((x, y), letter, font=font, fill=fore, stroke_width=0)


def wait_for(text, patience):
    until = time.monotonic() + patience
    while text not in tmux("capture-pane", "-p", "-t", "shot"):
        if time.monotonic() > until:
            raise SystemExit(f"{text!r} did not appear")
        time.sleep(0.2)


def shoot(program, folder, name, size, script, scene="demonstration"):
    with tempfile.TemporaryDirectory() as place:
        command = f"cd {place} && COLORTERM=truecolor LANG=C.UTF-8 {program} explore {scene} --no-record"
        tmux("new-session", "-d", "-s", "shot", "-x", str(size[0]), "-y", str(size[1]), command)
        try:
            for keys, text, patience in script:
                if keys:
                    tmux("send-keys", "-t", "shot", *keys)
                wait_for(text, patience)
            time.sleep(1)
            image = draw(tmux("capture-pane", "-e", "-p", "-t", "shot"), size)
            few = image.quantize(192, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
            few.save(folder / name, optimize=True)
            print(folder / name)
        finally:
            tmux("kill-server")
            time.sleep(1)  # the next one needs its socket


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--patience", type=float, default=300.0, help="seconds to wait for a screen (default: %(default)s)")
    arguments = parser.parse_args()
    program, patience = arguments.program.resolve(), arguments.patience
    # The default scene on the quick mesh, its period replayed, the curve of life against S filled in.
    swept = [([], "sweeping S", patience), ([], "sweeping S 15/", patience)]
    shoot(program, arguments.folder, "explorer.png", (160, 48), swept, "demonstration_quick")
    # The second lesson at S = 0.5, its question answered: the comb.
    comb = [(["t", "2"], "2/10", patience), (["n"], "(2/4)", patience), (["n"], "(3/4)", patience), (["1"], "Right:", patience)]
    shoot(program, arguments.folder, "explorer_lesson.png", (160, 48), comb, "demonstration_quick")
    shoot(program, arguments.folder, "explorer_80x24.png", (80, 24), [([], "live", patience), (["e"], "change the scene", patience)])


if __name__ == "__main__":
    main()
