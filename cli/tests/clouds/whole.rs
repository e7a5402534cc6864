//! A point cloud taken apart by a reader of the tests' own: header, records, points, and what stands behind them.

use std::io::Cursor;

/// The parts of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Whole {
    /// The header, without bounds, the places of other parts, and whether points are compressed.
    pub header: Vec<u8>,
    /// The records before the points, without that of LASzip.
    pub records: Vec<Vec<u8>>,
    /// What stands between them and the points.
    pub between: Vec<u8>,
    /// The points, decompressed.
    pub points: Vec<Vec<u8>>,
    /// The extended records.
    pub behind: Vec<u8>,
}

pub fn number<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes[at..at + N].try_into().expect("within")
}

fn long(bytes: &[u8], at: usize) -> usize {
    usize::try_from(u64::from_le_bytes(number(bytes, at))).expect("small")
}

fn middle(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(number(bytes, at)) as usize
}

fn short(bytes: &[u8], at: usize) -> usize {
    u16::from_le_bytes(number(bytes, at)).into()
}

impl Whole {
    pub fn of(file: &[u8]) -> Self {
        let (size, points_at, length) = (short(file, 94), middle(file, 96), short(file, 105));
        let is_1_4 = file[25] == 4;
        let count = if is_1_4 { long(file, 247) } else { middle(file, 107) };
        let (mut records, mut laszip, mut at) = (Vec::new(), None, size);
        for _ in 0..middle(file, 100) {
            let end = at + 54 + short(file, at + 20);
            if file[at + 2..].starts_with(b"laszip encoded\0") {
                laszip = Some(file[at + 54..end].to_vec());
            } else {
                records.push(file[at..end].to_vec());
            }
            at = end;
        }
        assert_eq!(laszip.is_some(), file[104] & 0x80 != 0, "compressed, and a record says how");
        let mut points = vec![0; count * length];
        let mut end = points_at + points.len();
        if let Some(laszip) = laszip {
            let how = laz::LazVlr::from_buffer(&laszip).expect("a way");
            let mut cursor = Cursor::new(file);
            cursor.set_position(points_at as u64);
            if count > 0 {
                let mut codec = laz::LasZipDecompressor::new(cursor, how).expect("a codec");
                codec.decompress_many(&mut points).expect("points");
            }
            end = file.len();
        } else {
            points.copy_from_slice(&file[points_at..end]);
        }
        let mut behind = Vec::new();
        let waveforms = if file[25] >= 3 { long(file, 227) } else { 0 };
        if is_1_4 && middle(file, 243) > 0 {
            behind = file[long(file, 235)..].to_vec();
        } else if waveforms > 0 {
            behind = file[waveforms..].to_vec();
        } else {
            assert_eq!(end, file.len(), "nothing stands behind the points");
        }
        let mut header = file[..size].to_vec();
        let later = [(3, 227..235), (4, 235..243)].into_iter().filter(|(since, _)| file[25] >= *since);
        let places = [96..104, 179..227].into_iter().chain(later.map(|(_, place)| place));
        places.for_each(|place| header[place].fill(0));
        header[104] &= 0x3f;
        let points = points.chunks(length).map(<[u8]>::to_vec).collect();
        Self { header, records, between: file[at..points_at].to_vec(), points, behind }
    }

    /// The steps of each point.
    pub fn steps(&self) -> Vec<[i32; 3]> {
        let steps = |point: &Vec<u8>| [0, 4, 8].map(|at| i32::from_le_bytes(number(point, at)));
        self.points.iter().map(steps).collect()
    }

    /// The same file with its points at the origin.
    pub fn without_coordinates(mut self) -> Self {
        self.points.iter_mut().for_each(|point| point[..12].fill(0));
        self
    }
}

/// Smallest and largest x, y and z, as the header of a file has them.
pub fn bounds(file: &[u8]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|axis| {
        let [largest, smallest] = [0, 8].map(|more| f64::from_le_bytes(number(file, 179 + 16 * axis + more)));
        [smallest, largest]
    })
}

/// The coordinates that steps mean in a file.
pub fn coordinates(file: &[u8], steps: &[[i32; 3]]) -> Vec<[f64; 3]> {
    let field = |at: usize| f64::from_le_bytes(number(file, at));
    let of = |steps: &[i32; 3]| {
        [0, 1, 2].map(|axis| f64::from(steps[axis]) * field(131 + 8 * axis) + field(155 + 8 * axis))
    };
    steps.iter().map(of).collect()
}
