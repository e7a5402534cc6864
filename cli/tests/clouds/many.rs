//! More points than one chunk and one batch hold.

use std::io::Cursor;

use laz::{LazVlrBuilder, ParLasZipCompressor};

use crate::whole::{Whole, number};
use crate::{applied, bytes, folder};

/// A file with the points of `v12f1.las`, over and over.
fn many(count: usize) -> Vec<u8> {
    let small = bytes("v12f1.las");
    let points_at = u32::from_le_bytes(number(&small, 96)) as usize;
    let mut file = small[..points_at].to_vec();
    file.extend(small[points_at..].iter().cycle().take(count * 57));
    file[107..111].copy_from_slice(&u32::try_from(count).expect("small").to_le_bytes());
    file
}

/// The same compressed in chunks of these sizes, by the codec alone.
fn in_chunks(plain: &[u8], sizes: &[usize]) -> Vec<u8> {
    let points_at = u32::from_le_bytes(number(plain, 96)) as usize;
    let how = LazVlrBuilder::default()
        .with_point_format(1, 29)
        .expect("format 1")
        .with_variable_chunk_size()
        .build();
    let mut content = Vec::new();
    how.write_to(&mut content).expect("a record");
    let mut head = plain[..points_at].to_vec();
    head[104] |= 0x80;
    head[100] += 1;
    head.extend([0, 0]);
    head.extend(b"laszip encoded\0\0");
    head.extend(22204_u16.to_le_bytes());
    head.extend(u16::try_from(content.len()).expect("short").to_le_bytes());
    head.extend([0; 32]);
    head.extend(&content);
    let at = u32::try_from(head.len()).expect("small").to_le_bytes();
    head[96..100].copy_from_slice(&at);
    let mut out = Cursor::new(head);
    out.set_position(u32::from_le_bytes(at).into());
    let mut codec = ParLasZipCompressor::new(out, how).expect("a codec");
    let (mut chunks, mut rest) = (Vec::new(), &plain[points_at..]);
    for size in sizes {
        let (chunk, more) = rest.split_at(size * 57);
        chunks.push(chunk);
        rest = more;
    }
    assert!(rest.is_empty(), "every point has a chunk");
    codec.compress_chunks(chunks).expect("compressed");
    codec.done().expect("compressed");
    codec.into_inner().into_inner()
}

#[test]
fn many_points_are_corrected_as_few_are() {
    // More than one batch, and a last chunk that is not full.
    let count = (1 << 19) + 50_001;
    let folder = folder("cloud_many", &[]);
    let file = many(count);
    folder.write("many.las", &file);
    let plain = applied(&folder, "many.las", "plain.las", &[]);
    let packed = applied(&folder, "many.las", "packed.laz", &[]);
    assert!(packed.len() < plain.len() * 2 / 3, "{} of {}", packed.len(), plain.len());
    let [plain, packed] = [plain, packed].map(|file| Whole::of(&file));
    let expected: Vec<[f64; 3]> = crate::steps("v12f1").into_iter().cycle().take(count).collect();
    crate::assert_steps("many", &plain.steps(), &expected);
    assert!(plain == packed, "the same, compressed");

    // Chunks of several sizes stay as they are.
    let sizes = [1, 70_000, 3, 400_000, count - 470_005, 1];
    folder.write("chunks.laz", in_chunks(&file, &sizes));
    let chunks = applied(&folder, "chunks.laz", "chunks.out.laz", &[]);
    assert!(Whole::of(&chunks) == plain, "the same, in chunks of several sizes");
    let table = |file: &[u8]| {
        let how = LazVlrBuilder::default()
            .with_point_format(1, 29)
            .expect("format 1")
            .with_variable_chunk_size()
            .build();
        let mut cursor = Cursor::new(file);
        cursor.set_position(u32::from_le_bytes(number(file, 96)).into());
        let table = laz::laszip::ChunkTable::read_from(cursor, &how).expect("a table");
        table
            .as_ref()
            .iter()
            .map(|chunk| usize::try_from(chunk.point_count).expect("small"))
            .collect::<Vec<_>>()
    };
    assert_eq!(table(&chunks), sizes);
}
