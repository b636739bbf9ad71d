#!/usr/bin/env python3
"""Builds the explorer as a page: target/web/asperity.html (one file) and target/web/folder (for servers). Prints the sizes.

Needs Rust's target wasm32-unknown-unknown (rustup target add wasm32-unknown-unknown) and nothing else."""
import base64
import gzip
import os
import pathlib
import subprocess
import sys

ASSETS = pathlib.Path(__file__).resolve().parent
ROOT = ASSETS.parent.parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
MOST_BYTES = 3_000_000
MOST_PACKED = 1_200_000


def module():
    """Compiles the module; gives its bytes."""
    crates = pathlib.Path(os.environ.get("CARGO_HOME", pathlib.Path.home() / ".cargo")) / "registry/src"
    # The profile's strip leaves the functions' names, 80 kB of the packed page.
    flags = (f"{os.environ.get('RUSTFLAGS', '')} -C target-feature=+simd128 -C link-arg=--strip-all "
             f"--remap-path-prefix={ROOT}=. --remap-path-prefix={crates}=crates")
    subprocess.run(
        ["cargo", "rustc", "--locked", "--profile", "web", "--target", "wasm32-unknown-unknown", "--lib",
         "--package", "asperity-explorer", "--crate-type", "cdylib"],
        cwd=ROOT, check=True, env={**os.environ, "RUSTFLAGS": flags.strip()})
    return (TARGET / "wasm32-unknown-unknown/web/asperity_explorer.wasm").read_bytes()


def text(name):
    return (ASSETS / name).read_text()


def filled(policy, style, scripts):
    return text("page.html").replace("{{policy}}", policy).replace("{{style}}", style).replace("{{scripts}}", scripts)


def main():
    wasm = module()
    packed = gzip.compress(wasm, 9, mtime=0)
    out = ROOT / "target/web"
    folder = out / "folder"
    folder.mkdir(parents=True, exist_ok=True)
    shut = "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data: blob:; "
    one = filled(
        shut + "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; style-src 'unsafe-inline'; worker-src blob:",
        f"<style>\n{text('page.css')}</style>",
        f'<script id="module" type="application/octet-stream">{base64.b64encode(packed).decode()}</script>\n'
        f'<script id="worker" type="text/plain">\n{text("worker.js")}</script>\n'
        f'<script>\n{text("painter.js")}</script>\n<script>\n{text("page.js")}</script>')
    (out / "asperity.html").write_text(one)
    many = filled(
        shut + "script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; worker-src 'self'; connect-src 'self'",
        '<link rel="stylesheet" href="page.css">',
        '<script src="painter.js"></script>\n<script src="page.js"></script>')
    (folder / "index.html").write_text(many)
    for name in ["page.css", "page.js", "painter.js", "worker.js"]:
        (folder / name).write_text(text(name))
    (folder / "asperity.wasm.gz").write_bytes(packed)
    size, squeezed = len(one.encode()), len(gzip.compress(one.encode(), 9, mtime=0))
    print(f"module {len(wasm)} bytes; asperity.html {size} bytes, compressed {squeezed}")
    if size > MOST_BYTES or squeezed > MOST_PACKED:
        sys.exit(f"larger than {MOST_BYTES} or {MOST_PACKED} bytes")


main()
