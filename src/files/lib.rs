//! E57 and LAZ files for `readCloud`, over the crates `e57` and `laz`. JavaScript supplies parts of the file as they are
//! needed, so a file may be larger than the memory. Each file has an instance of this module for itself.

mod columns;
mod laz;
mod partial_file;
mod scan;

use std::cell::RefCell;

use e57::E57Reader;

use columns::columns_of;
use laz::{Chunk, Laz};
use partial_file::PartialFile;
use scan::{Scan, facts_of};
#[cfg(target_family = "wasm")]
use wasm_bindgen as _;

/// Answers besides counts of rows: a part of the file is missing; the file is refused.
const MISSING: i32 = -1;
const REFUSED: i32 = -2;

#[derive(Default)]
struct Reading {
    parts: PartialFile,
    is_open: bool,
    scan: Option<Scan>,
    laz: Option<Laz>,
    chunk: Option<Chunk>,
    /// Compressed bytes of JavaScript, or points of LAZ for it.
    bytes: Vec<u8>,
    /// Numbers for JavaScript: those that describe each scan, or those of rows.
    numbers: Vec<f64>,
    /// The description of the file, or why it is refused.
    text: String,
}

thread_local! {
    static READING: RefCell<Reading> = RefCell::default();
}

/// Says how long the file is.
#[unsafe(no_mangle)]
pub extern "C" fn begin(size: f64) {
    READING.with_borrow_mut(|reading| reading.parts.begin(size as u64));
}

/// Where to write the bytes of a part of the file.
#[unsafe(no_mangle)]
pub extern "C" fn supply(from: f64, length: usize) -> *mut u8 {
    READING.with_borrow_mut(|reading| reading.parts.supply(from as u64, length, !reading.is_open))
}

/// The first byte that is missing.
#[unsafe(no_mangle)]
pub extern "C" fn missing() -> f64 {
    READING.with_borrow(|reading| reading.parts.missing().unwrap_or_default() as f64)
}

#[unsafe(no_mangle)]
pub extern "C" fn text_at() -> *const u8 {
    READING.with_borrow(|reading| reading.text.as_ptr())
}

#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    READING.with_borrow(|reading| reading.text.len())
}

#[unsafe(no_mangle)]
pub extern "C" fn numbers_at() -> *const f64 {
    READING.with_borrow(|reading| reading.numbers.as_ptr())
}

/// Describes the file: in the text the coordinate system, a line for each scan and for each of its columns; in the
/// numbers the facts of each scan. Returns the number of scans.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> i32 {
    answered(|reading| {
        let file = E57Reader::new(reading.parts.clone()).map_err(|error| error.to_string())?;
        let clouds = file.pointclouds();
        let mut text = one_line(file.coordinate_metadata().unwrap_or_default());
        reading.numbers.clear();
        for cloud in &clouds {
            text += &format!(
                "\nscan\t{}\t{}",
                cloud.records,
                one_line(cloud.name.as_deref().unwrap_or_default())
            );
            for column in columns_of(cloud) {
                text += &format!("\n{}\t{}", column.kind, one_line(&column.name));
            }
            reading.numbers.extend(facts_of(cloud)?);
        }
        reading.text = text;
        reading.is_open = true;
        Ok(clouds.len())
    })
}

/// Begins to read a scan.
#[unsafe(no_mangle)]
pub extern "C" fn begin_scan(index: usize) -> i32 {
    answered(|reading| {
        reading.scan = None;
        reading.scan = Some(Scan::new(reading.parts.clone(), index)?);
        Ok(0)
    })
}

/// Reads the next rows: x, y, z and the columns. Returns how many there are; 0 is the end of the scan.
#[unsafe(no_mangle)]
pub extern "C" fn next_rows() -> i32 {
    answered(|reading| {
        reading.numbers.clear();
        reading
            .scan
            .as_mut()
            .ok_or("no scan was begun")?
            .read(&mut reading.numbers)
    })
}

/// Where to write bytes of LAZ. After `next_points`, the points are there.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    READING.with_borrow_mut(|reading| {
        reading.bytes.clear();
        reading.bytes.resize(length, 0);
        reading.bytes.as_mut_ptr()
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn bytes_at() -> *const u8 {
    READING.with_borrow(|reading| reading.bytes.as_ptr())
}

/// Says how the points of a LAZ file are compressed.
#[unsafe(no_mangle)]
pub extern "C" fn begin_laz(format: usize, row: usize, version: u32) -> i32 {
    stepped(|reading| {
        reading.laz = Some(Laz::new(format, row, version)?);
        Ok(0)
    })
}

/// Reads the table of chunks from the bytes in `room`: for each chunk, the numbers are its points and its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn chunk_table(has_points: bool) -> i32 {
    stepped(|reading| {
        reading.numbers = laz::table(&reading.bytes, has_points)?;
        Ok(reading.numbers.len() / 2)
    })
}

/// Begins with the chunk in `room`. Returns how many points it holds.
#[unsafe(no_mangle)]
pub extern "C" fn begin_chunk(points: usize) -> i32 {
    stepped(|reading| {
        let laz = reading.laz.as_ref().ok_or("no LAZ file was begun")?;
        let chunk = laz.chunk(std::mem::take(&mut reading.bytes), points)?;
        let points = chunk.points;
        reading.chunk = Some(chunk);
        Ok(points)
    })
}

/// Decompresses the next points of the chunk. Returns how many there are; 0 after the last one.
#[unsafe(no_mangle)]
pub extern "C" fn next_points() -> i32 {
    stepped(|reading| {
        let chunk = reading.chunk.as_mut().ok_or("no chunk was begun")?;
        chunk.read(&mut reading.bytes)
    })
}

/// Runs a step that has all bytes that it needs.
fn stepped(step: impl FnOnce(&mut Reading) -> Result<usize, String>) -> i32 {
    READING.with_borrow_mut(|reading| match step(reading) {
        Ok(count) => count as i32,
        Err(says) => {
            reading.text = says;
            REFUSED
        }
    })
}

/// Runs a step of E57. If it has come to nothing because a part is missing, it can be tried again with this part.
fn answered(step: impl FnOnce(&mut Reading) -> Result<usize, String>) -> i32 {
    READING.with_borrow_mut(|reading| {
        reading.parts.forget_missing();
        let answer = step(reading);
        let is_missing = reading.parts.missing().is_some();
        match answer {
            Ok(count) if count > 0 || !is_missing => count as i32,
            _ if is_missing => MISSING,
            Ok(_) => 0,
            Err(says) => {
                reading.text = format!("{says}, near byte {}", reading.parts.last_read());
                REFUSED
            }
        }
    })
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
