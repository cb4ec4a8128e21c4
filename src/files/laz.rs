//! Points of LAZ files, over the crate `laz`. JavaScript finds the chunks, which can be decompressed alone.

use std::io::Cursor;

use laz::las::{Point0, Point1, Point2, Point3, Point4, Point5};
use laz::laszip::ChunkTable;
use laz::record::{
    LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor,
};
use laz::{LazItem, LazItemRecordBuilder};

type Bytes = Cursor<Vec<u8>>;

/// So many points are decompressed at a time.
const BATCH: usize = 8192;
/// The decoder reads so many bytes ahead of the point that it decodes. Writers add no more.
const AHEAD: usize = 8;
/// The bytes of a point of each format.
const LEAST: [usize; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];
/// The layers of the formats from 6 on. Each extra byte of a point has one more.
const LAYERS: [usize; 5] = [9, 10, 11, 10, 12];

/// How the points of a file are compressed.
pub struct Laz {
    items: Vec<LazItem>,
    row: usize,
    /// 0 in the older formats.
    layers: usize,
}

impl Laz {
    /// `version` is that of the items: 1 or 2 in the formats before 6, and 3 from there on.
    pub fn new(format: usize, row: usize, version: u32) -> Result<Self, String> {
        let refused = || format!("its LAZ points have format {format} and version {version}");
        let least = *LEAST.get(format).ok_or_else(refused)?;
        let extra = row
            .checked_sub(least)
            .ok_or("its points are shorter than their format")?;
        let bytes = u16::try_from(extra).map_err(|_| refused())?;
        let items = match (version, format) {
            (1, 0) => LazItemRecordBuilder::version_1_of::<Point0>(bytes),
            (1, 1) => LazItemRecordBuilder::version_1_of::<Point1>(bytes),
            (1, 2) => LazItemRecordBuilder::version_1_of::<Point2>(bytes),
            (1, 3) => LazItemRecordBuilder::version_1_of::<Point3>(bytes),
            (1, 4) => LazItemRecordBuilder::version_1_of::<Point4>(bytes),
            (1, 5) => LazItemRecordBuilder::version_1_of::<Point5>(bytes),
            (2, 0..=5) | (3, 6..) => {
                LazItemRecordBuilder::default_for_point_format_id(format as u8, bytes)
                    .map_err(|error| error.to_string())?
            }
            _ => return Err(refused()),
        };
        let layers = if format < 6 {
            0
        } else {
            LAYERS[format - 6] + extra
        };
        Ok(Self { items, row, layers })
    }

    /// Begins with a chunk.
    pub fn chunk(&self, mut bytes: Vec<u8>, points: usize) -> Result<Chunk, String> {
        let length = bytes.len();
        let short = || format!("has {length} bytes, too few for a chunk of points");
        let mut points = points;
        let mut rows: Box<dyn RecordDecompressor<Bytes>> = if self.layers == 0 {
            if length < self.row {
                return Err(short());
            }
            bytes.resize(length + AHEAD, 0);
            Box::new(SequentialPointRecordDecompressor::new(Cursor::new(bytes)))
        } else {
            // The first point, the number of points, and the length of each layer.
            let head = self.row + 4 + 4 * self.layers;
            let numbers = bytes.get(self.row..head).ok_or_else(short)?;
            let mut numbers = numbers
                .chunks_exact(4)
                .map(|four| u32::from_le_bytes([four[0], four[1], four[2], four[3]]));
            points = numbers.next().unwrap_or_default() as usize;
            let end = head as u64 + numbers.map(u64::from).sum::<u64>();
            if end != length as u64 {
                return Err(format!("is listed with {length} bytes, but holds {end}"));
            }
            Box::new(LayeredPointRecordDecompressor::new(Cursor::new(bytes)))
        };
        rows.set_fields_from(&self.items)
            .map_err(|error| error.to_string())?;
        Ok(Chunk {
            rows,
            row: self.row,
            length: if self.layers == 0 { length } else { 0 },
            points,
            read: 0,
            has_failed: false,
        })
    }
}

/// A chunk that is being decompressed.
pub struct Chunk {
    rows: Box<dyn RecordDecompressor<Bytes>>,
    row: usize,
    /// Its bytes, if they are decoded in one stream.
    length: usize,
    pub points: usize,
    read: usize,
    /// Whether the next point is not there.
    has_failed: bool,
}

impl Chunk {
    /// Decompresses the next points. Returns how many there are; 0 after the last one. Points before a damaged place
    /// come first, and then the error.
    pub fn read(&mut self, into: &mut Vec<u8>) -> Result<usize, String> {
        if self.has_failed {
            return Err(format!("ends after {} points", self.read));
        }
        let count = BATCH.min(self.points - self.read);
        into.clear();
        into.resize(count * self.row, 0);
        for i in 0..count {
            let point = &mut into[i * self.row..][..self.row];
            let is_read = self.rows.decompress_next(point).is_ok();
            if !is_read || self.is_beyond() {
                self.read += i;
                self.has_failed = true;
                return if i == 0 { self.read(into) } else { Ok(i) };
            }
        }
        self.read += count;
        if count == 0 && self.left() > AHEAD {
            return Err(format!("holds more than its {} points", self.points));
        }
        Ok(count)
    }

    fn left(&self) -> usize {
        self.length
            .saturating_sub(self.rows.get().position() as usize)
    }

    /// Whether the last point needed bytes after the chunk.
    fn is_beyond(&self) -> bool {
        self.length > 0 && self.rows.get().position() as usize > self.length
    }
}

/// The number of points and of bytes of each chunk, by the table after them. Without `has_points`, there are only bytes.
pub fn table(bytes: &[u8], has_points: bool) -> Result<Vec<f64>, String> {
    let table = ChunkTable::read(&mut Cursor::new(bytes), has_points);
    let table = table.map_err(|error| error.to_string())?;
    let entries = table.as_ref().iter();
    Ok(entries
        .flat_map(|entry| [entry.point_count as u32, entry.byte_count as u32].map(f64::from))
        .collect())
}
