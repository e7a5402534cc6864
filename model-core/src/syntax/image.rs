//! The image point of an `observe` statement: `image(px, py, pz of flange; fx, fy, cx, cy, k1, k2, p1, p2)`.

use proc_macro2::{Delimiter, Span};

use super::amount;
use super::declaration::ImageTerm;
use super::tokens::Reader;
use crate::chain::image::{INTRINSICS, NAMES};
use crate::expr::Expr;
use crate::mistake::Mistake;

/// The kind of observable that shows where a camera sees a point.
pub const IMAGE: &str = "image";

/// What an image point is written as.
pub const IMAGE_HELP: &str = "write `image(px, py, pz; fx, fy, cx, cy, k1, k2, p1, p2) of camera`, with 0 where the lens has no \
     distortion; a point of another body is `image(px, py, pz of body; …)`";

type Parts = ([Option<Expr<Span>>; 3], ImageTerm);

/// What stands in the parentheses.
pub fn image(reader: &mut Reader<'_, '_>) -> Result<Parts, Mistake<Span>> {
    let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) else {
        return Err(reader
            .expected("the point and the camera's numbers in parentheses")
            .with_help(IMAGE_HELP));
    };
    reader
        .inside(inside, parentheses.close, |reader| {
            let point = amounts::<3>(reader, "three components of the point")?;
            let target = match reader.peek_word() {
                Some(word) if word == "of" => {
                    reader.word();
                    Some(reader.name("the name of the body that carries the point")?)
                }
                _ => None,
            };
            if reader.mark(';').is_none() {
                return Err(reader.expected("`;` and the camera's numbers"));
            }
            let what = format!("{INTRINSICS} numbers of the camera ({})", NAMES.join(", "));
            let intrinsics = amounts::<INTRINSICS>(reader, &what)?;
            if !reader.is_at_end() {
                return Err(reader.expected(&format!("no more than {what}")));
            }
            Ok((point, ImageTerm { target, intrinsics }))
        })
        .map_err(|mistake| mistake.with_help(IMAGE_HELP))
}

/// So many amounts with commas between them.
fn amounts<const N: usize>(
    reader: &mut Reader<'_, '_>,
    what: &str,
) -> Result<[Option<Expr<Span>>; N], Mistake<Span>> {
    let mut read = Vec::with_capacity(N);
    loop {
        let before = reader.mistakes.len();
        read.push(amount::part(reader));
        if reader.mistakes.len() > before {
            // Told already; what stands behind it in the parentheses cannot be counted.
            reader.mistakes.truncate(before + 1);
            let mistake = reader.mistakes.pop().unwrap_or_else(|| reader.expected(what));
            return Err(mistake);
        }
        if read.len() == N {
            break;
        }
        if reader.mark(',').is_none() {
            return Err(reader.expected(&format!("`,`: here are {} of {what}", read.len())));
        }
    }
    read.try_into().map_err(|_| reader.expected(what))
}
