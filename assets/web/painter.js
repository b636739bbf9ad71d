// Paints cells, curves and the map's pixels on a canvas. Blocks, Braille dots and frames are drawn as shapes, so that they meet.
"use strict";

const INK = "#dee2eb";
const PAPER = "#0d0f14";
const FONT = 'ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, "Liberation Mono", monospace';
const BOLD = 1, DIM = 2, ITALIC = 4, UNDERLINED = 8, REVERSED = 16;
const NO_COLOUR = 0xffffffff;
// Arms of box-drawing characters: up, down, left, right.
const ARMS = {
  "─": "lr", "│": "ud", "┌": "dr", "┐": "dl", "└": "ur", "┘": "ul", "╭": "dr", "╮": "dl", "╰": "ur", "╯": "ul",
  "├": "udr", "┤": "udl", "┬": "dlr", "┴": "ulr", "┼": "udlr", "━": "lr", "┃": "ud", "╴": "l", "╶": "r", "╵": "u", "╷": "d",
};
// Quadrants of U+2596 and on: upper left 1, upper right 2, lower left 4, lower right 8.
const QUADRANTS = [4, 8, 1, 13, 9, 7, 11, 2, 6, 14];

class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    this.columns = this.rows = 0;
    this.room = [0, 0, 0, 0];
    this.image = null;
    this.plots = [];
  }

  // Columns, rows, and pixels of a cell for a room of so many CSS pixels.
  fit(width, height, ratio) {
    let size = Math.min(26, Math.max(13, width / 160 / 0.6));
    // A phone held upright gets the narrow screen: one picture, life and knobs.
    const isNarrow = width < 600 && height > 1.1 * width;
    size = isNarrow ? Math.min(width / 46 / 0.602, height / 31 / 1.25) : Math.min(size, width / 60 / 0.602, height / 20 / 1.25);
    size = Math.max(4, Math.floor(size * ratio * 2) / 2);
    this.context.font = `${size}px ${FONT}`;
    const cellWidth = Math.max(2, Math.floor(this.context.measureText("M").width));
    const cellHeight = Math.max(4, Math.round(size * 1.25));
    const columns = Math.max(1, Math.floor((width * ratio) / cellWidth));
    const rows = Math.max(1, Math.floor((height * ratio) / cellHeight));
    this.next = { size, cellWidth, cellHeight, columns, rows, ratio };
    return [columns, rows, cellWidth, cellHeight];
  }

  // The module has taken that size: all cells come anew.
  begin([columns, rows, cellWidth, cellHeight]) {
    const n = this.next;
    if (n && n.columns === columns && n.rows === rows) Object.assign(this, n);
    else Object.assign(this, { columns, rows, cellWidth, cellHeight });
    this.canvas.width = columns * cellWidth;
    this.canvas.height = rows * cellHeight;
    this.canvas.style.width = `${this.canvas.width / this.ratio}px`;
    this.canvas.style.height = `${this.canvas.height / this.ratio}px`;
    const all = columns * rows;
    this.letters = new Array(all).fill(" ");
    this.looks = new Uint32Array(3 * all);
    for (let i = 0; i < all; i++) this.looks.set([NO_COLOUR, NO_COLOUR, 0], 3 * i);
    this.room = [0, 0, 0, 0];
    this.image = null;
    this.plots = [];
    this.context.fillStyle = PAPER;
    this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.context.textBaseline = "middle";
    this.context.textAlign = "center";
  }

  cells(bytes) {
    const numbers = new DataView(bytes.buffer);
    const word = (i) => numbers.getUint32(4 * i, true);
    const runs = word(0);
    const room = [word(2), word(3), word(4), word(5)];
    const letters = [...new TextDecoder().decode(bytes.subarray(24 + 20 * runs))];
    const touched = [];
    let next = 0;
    for (let run = 0; run < runs; run++) {
      const at = 6 + 5 * run;
      const column = word(at) & 0xffff, row = word(at) >>> 16;
      for (let k = 0; k < word(at + 1); k++) {
        const i = row * this.columns + column + k;
        this.letters[i] = letters[next++];
        this.looks.set([word(at + 2), word(at + 3), word(at + 4)], 3 * i);
        touched.push(i);
      }
    }
    if (room.join() !== this.room.join()) {
      const left = this.room;
      this.room = room;
      this.image = null;
      this.each(left, (i) => this.cell(i));
    }
    for (const i of touched) this.cell(i);
    for (const plot of this.plots) {
      const [left, top, columns, rows] = plot.room;
      plot.isOld ||= touched.some((i) => {
        const column = i % this.columns, row = (i - column) / this.columns;
        return column >= left && column < left + columns && row >= top && row < top + rows;
      });
    }
  }

  // Plots with their curves, which stay until others come.
  curves(bytes) {
    const numbers = new DataView(bytes.buffer);
    let at = 0;
    const word = () => numbers.getUint32(4 * at++, true);
    const before = this.plots;
    this.plots = Array.from({ length: word() }, () => {
      const room = [word(), word(), word(), word()];
      const curves = Array.from({ length: word() }, () => {
        const [colour, isDotted, points] = [word(), word() === 1, word()];
        const places = new Float32Array(bytes.buffer, 4 * at, 2 * points);
        at += 2 * points;
        return { ink: colour === NO_COLOUR ? INK : colourText(colour), isDotted, places };
      });
      return { room, curves, isOld: true };
    });
    const rooms = new Set(this.plots.map((plot) => plot.room.join()));
    for (const plot of before) if (!rooms.has(plot.room.join())) this.each(plot.room, (i) => this.cell(i));
  }

  // Paints those plots anew whose curves or cells have changed.
  paintPlots() {
    for (const plot of this.plots.filter((plot) => plot.isOld)) {
      plot.isOld = false;
      this.plot(plot);
    }
  }

  plot({ room, curves }) {
    const { context, cellWidth, cellHeight } = this;
    const [x, y, width, height] = [room[0] * cellWidth, room[1] * cellHeight, room[2] * cellWidth, room[3] * cellHeight];
    const paper = this.paper(room);
    context.save();
    context.beginPath();
    context.rect(x, y, width, height);
    context.clip();
    context.fillStyle = paper;
    context.fillRect(x, y, width, height);
    context.lineWidth = Math.max(1, cellWidth / 6);
    context.lineJoin = "round";
    const dot = Math.max(1, Math.round(cellWidth / 6));
    for (const { ink, isDotted, places } of curves) {
      context.fillStyle = context.strokeStyle = ink;
      context.beginPath();
      let isJoined = false;
      for (let k = 0; k < places.length; k += 2) {
        const [left, top] = [x + places[k] * cellWidth, y + places[k + 1] * cellHeight];
        if (isDotted) context.fillRect(left - dot / 2, top - dot / 2, dot, dot);
        else if (isJoined) context.lineTo(left, top);
        else context.moveTo(left, top);
        isJoined = !Number.isNaN(left);
      }
      context.stroke();
    }
    context.restore();
    this.each(room, (i) => {
      if (this.letters[i] !== " ") this.cell(i, paper);
    });
  }

  // The paper of a room's first cell.
  paper([left, top]) {
    const paper = this.looks[3 * (top * this.columns + left) + 1];
    return paper === NO_COLOUR ? PAPER : colourText(paper);
  }

  picture(bytes) {
    const numbers = new DataView(bytes.buffer);
    const [left, top, columns, rows, width, height] = [0, 1, 2, 3, 4, 5].map((i) => numbers.getUint32(4 * i, true));
    const pixels = new ImageData(new Uint8ClampedArray(bytes.buffer, 24, 4 * width * height), width, height);
    if (!this.image || this.image.width !== width || this.image.height !== height) {
      this.image = new OffscreenCanvas(width, height);
    }
    this.image.getContext("2d").putImageData(pixels, 0, 0);
    const [x, y] = [left * this.cellWidth, top * this.cellHeight];
    const [w, h] = [columns * this.cellWidth, rows * this.cellHeight];
    const context = this.context;
    context.fillStyle = this.paper(this.room);
    context.fillRect(x, y, w, h);
    context.imageSmoothingEnabled = true;
    context.drawImage(this.image, x, y, w, h);
    this.each([left, top, columns, rows], (i) => {
      if (this.letters[i] !== " ") this.cell(i);
    });
  }

  each([left, top, columns, rows], work) {
    for (let row = top; row < Math.min(top + rows, this.rows); row++) {
      for (let column = left; column < Math.min(left + columns, this.columns); column++) work(row * this.columns + column);
    }
  }

  isInRoom(column, row) {
    const [left, top, columns, rows] = this.room;
    return column >= left && column < left + columns && row >= top && row < top + rows;
  }

  // Paints a cell; its paper only where that is not what lies below it.
  cell(i, below) {
    const column = i % this.columns, row = (i - column) / this.columns;
    const letter = this.letters[i];
    if (letter === " " && this.image && this.isInRoom(column, row)) return;
    let [ink, paper, weight] = this.looks.subarray(3 * i, 3 * i + 3);
    let inkText = ink === NO_COLOUR ? INK : colourText(ink);
    let paperText = paper === NO_COLOUR ? PAPER : colourText(paper);
    if (weight & REVERSED) [inkText, paperText] = [paperText, inkText];
    const x = column * this.cellWidth, y = row * this.cellHeight;
    const context = this.context;
    if (paperText !== below) {
      context.fillStyle = paperText;
      context.fillRect(x, y, this.cellWidth, this.cellHeight);
    }
    if (letter === " " || letter === undefined) return;
    context.globalAlpha = weight & DIM ? 0.6 : 1;
    context.fillStyle = inkText;
    if (!this.shape(letter, x, y)) {
      const font = `${weight & ITALIC ? "italic " : ""}${weight & BOLD ? "bold " : ""}${this.size}px ${FONT}`;
      if (context.font !== font) context.font = font;
      // What a bold letter has beyond its cell would stay when that cell is painted again.
      context.save();
      context.beginPath();
      context.rect(x, y, this.cellWidth, this.cellHeight);
      context.clip();
      context.fillText(letter, x + this.cellWidth / 2, y + this.cellHeight * 0.54, this.cellWidth * 1.1);
      context.restore();
    }
    if (weight & UNDERLINED) context.fillRect(x, y + this.cellHeight - 2, this.cellWidth, 1);
    context.globalAlpha = 1;
  }

  // Draws what is a shape; false: it is a letter.
  shape(letter, x, y) {
    const code = letter.charCodeAt(0);
    const { context, cellWidth: w, cellHeight: h } = this;
    const bar = (left, top, width, height) => {
      const [l, t] = [Math.round(left * w), Math.round(top * h)];
      context.fillRect(x + l, y + t, Math.round((left + width) * w) - l, Math.round((top + height) * h) - t);
    };
    if (code >= 0x2800 && code <= 0x28ff) {
      this.dots(code - 0x2800, x, y);
    } else if (ARMS[letter]) {
      const arms = ARMS[letter];
      const thick = Math.max(1, Math.round(w / (letter === "━" || letter === "┃" ? 5 : 10)));
      const [cx, cy] = [x + (w - thick) / 2 | 0, y + (h - thick) / 2 | 0];
      if (arms.includes("l")) context.fillRect(x, cy, cx - x + thick, thick);
      if (arms.includes("r")) context.fillRect(cx, cy, x + w - cx, thick);
      if (arms.includes("u")) context.fillRect(cx, y, thick, cy - y + thick);
      if (arms.includes("d")) context.fillRect(cx, cy, thick, y + h - cy);
    } else if (code < 0x2580 || code > 0x259f) {
      return false;
    } else if (code === 0x2580) bar(0, 0, 1, 0.5);
    else if (code <= 0x2588) bar(0, 1 - (code - 0x2580) / 8, 1, (code - 0x2580) / 8);
    else if (code <= 0x258f) bar(0, 0, (0x2590 - code) / 8, 1);
    else if (code === 0x2590) bar(0.5, 0, 0.5, 1);
    else if (code <= 0x2593) {
      context.globalAlpha *= (code - 0x2590) / 4;
      bar(0, 0, 1, 1);
    } else if (code === 0x2594) bar(0, 0, 1, 0.125);
    else if (code === 0x2595) bar(0.875, 0, 0.125, 1);
    else {
      const quadrants = QUADRANTS[code - 0x2596];
      for (let q = 0; q < 4; q++) if (quadrants >> q & 1) bar((q & 1) / 2, (q >> 1) / 2, 0.5, 0.5);
    }
    return true;
  }

  dots(bits, x, y) {
    const places = [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2], [0, 3], [1, 3]];
    const size = Math.max(1, Math.round(this.cellWidth * 0.3));
    places.forEach(([column, row], bit) => {
      if (!(bits >> bit & 1)) return;
      const left = x + (column + 0.5) * this.cellWidth / 2, top = y + (row + 0.5) * this.cellHeight / 4;
      this.context.fillRect(Math.round(left - size / 2), Math.round(top - size / 2), size, size);
    });
  }

  // The screen as text, for who does not see it.
  text() {
    const lines = [];
    for (let row = 0; row < this.rows; row++) {
      const line = this.letters.slice(row * this.columns, (row + 1) * this.columns).join("");
      lines.push(line.replace(/[\u2500-\u259f\u2800-\u28ff]+/g, " ").trimEnd());
    }
    return lines.join("\n");
  }
}

function colourText(colour) {
  return `#${colour.toString(16).padStart(6, "0")}`;
}
