//! Kitty's graphics protocol: RGBA in base64, in pieces, scaled by the terminal to a number of cells.
//!
//! ```text
//! ESC _ G a=T,f=32,s=w,v=h,c=columns,r=rows,...,m=1 ; base64 ESC \        m: more pieces follow
//! ```
//! `z=-1` puts it under the letters, `C=1` leaves the cursor, `q=2` asks for no answer; the same number replaces
//! the picture before.

use std::io::Write as _;

use super::Bitmap;

/// Bytes of base64 in a piece.
const PIECE: usize = 4096;
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Takes the picture away.
pub(in crate::tui) const REMOVE: &[u8] = b"\x1b_Ga=d,d=I,i=7001,q=2\x1b\\";

/// The bytes that draw a picture where the cursor is.
pub(in crate::tui) fn encode(picture: &Bitmap) -> Vec<u8> {
    let text = base64(&picture.rgba);
    let mut out = Vec::with_capacity(text.len() + text.len() / 64 + 128);
    let pieces = text.chunks(PIECE).count();
    for (place, piece) in text.chunks(PIECE).enumerate() {
        let more = u8::from(place + 1 < pieces);
        // Writing to memory does not fail.
        let _ = if place == 0 {
            write!(
                out,
                "\x1b_Ga=T,f=32,s={},v={},c={},r={},i=7001,p=1,z=-1,C=1,q=2,m={more};",
                picture.width, picture.height, picture.area.width, picture.area.height
            )
        } else {
            write!(out, "\x1b_Gm={more};")
        };
        out.extend_from_slice(piece);
        out.extend_from_slice(b"\x1b\\");
    }
    out
}

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let at = |k: usize| u32::from(three.get(k).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= three.len() { letter } else { b'=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;

    #[test]
    fn base64_of_the_rfc() {
        let table = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, text) in table {
            assert_eq!(base64(plain.as_bytes()), text.as_bytes());
        }
    }

    #[test]
    fn pieces_follow_each_other_and_the_last_says_so() {
        let picture = Bitmap {
            area: Rect::new(0, 0, 10, 5),
            width: 40,
            height: 50,
            rgba: vec![7; 40 * 50 * 4],
        };
        let bytes = encode(&picture);
        let text = std::str::from_utf8(&bytes).expect("it is ASCII");
        let pieces: Vec<&str> = text.split_terminator("\x1b\\").collect();
        assert_eq!(pieces.len(), (40 * 50 * 4_usize).div_ceil(3).div_ceil(1024));
        assert!(pieces[0].starts_with("\x1b_Ga=T,f=32,s=40,v=50,c=10,r=5,"));
        let more = pieces.iter().filter(|piece| piece.contains("m=1;")).count();
        assert_eq!(more, pieces.len() - 1);
        let payload: String = pieces
            .iter()
            .filter_map(|piece| piece.split_once(';').map(|(_, rest)| rest))
            .collect();
        assert_eq!(payload.as_bytes(), base64(&picture.rgba));
    }
}
