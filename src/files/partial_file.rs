//! The parts of a file that are in memory.

use std::cell::{Cell, RefCell};
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

/// A file of which some parts are there. Clones share them, and each has a place of its own.
#[derive(Clone, Default)]
pub struct PartialFile {
    shared: Rc<Shared>,
    at: u64,
}

#[derive(Default)]
struct Shared {
    size: Cell<u64>,
    parts: RefCell<Vec<Piece>>,
    /// Where the last read piece begins and ends, and the end of what is there without a gap.
    from: Cell<u64>,
    to: Cell<u64>,
    until: Cell<u64>,
    missing: Cell<Option<u64>>,
}

struct Piece {
    from: u64,
    bytes: Vec<u8>,
    /// It is needed again for each scan.
    stays: bool,
}

impl Piece {
    fn end(&self) -> u64 {
        self.from + self.bytes.len() as u64
    }
}

impl PartialFile {
    pub fn begin(&self, size: u64) {
        self.shared.size.set(size);
    }

    /// Adds a part, whose bytes are to be written to the returned place. Forgets parts that were read before.
    pub fn supply(&self, from: u64, length: usize, stays: bool) -> *mut u8 {
        let mut parts = self.shared.parts.borrow_mut();
        parts.retain(|part| part.stays || part.end() > self.shared.from.get());
        let mut bytes = vec![0; length];
        let place = bytes.as_mut_ptr();
        parts.push(Piece { from, bytes, stays });
        place
    }

    pub fn forget_missing(&self) {
        self.shared.missing.set(None);
    }

    /// The first byte that was looked for in vain.
    pub fn missing(&self) -> Option<u64> {
        self.shared.missing.get()
    }

    /// Whether so many bytes after the last read one are there, or all that follow. If not, they are missing.
    pub fn has_ahead(&self, bytes: u64) -> bool {
        let Shared {
            size,
            to,
            until,
            missing,
            ..
        } = &*self.shared;
        if until.get() >= size.get() || until.get() - to.get() >= bytes {
            return true;
        }
        let end = self.end_from(until.get());
        until.set(end);
        let is_there = end >= size.get() || end - to.get() >= bytes;
        if !is_there {
            missing.set(Some(end));
        }
        is_there
    }

    /// Where the last read piece begins.
    pub fn last_read(&self) -> u64 {
        self.shared.from.get()
    }

    /// The end of what is there from a place on without a gap.
    fn end_from(&self, place: u64) -> u64 {
        let parts = self.shared.parts.borrow();
        let mut end = place;
        while let Some(part) = parts
            .iter()
            .find(|part| part.from <= end && end < part.end())
        {
            end = part.end();
        }
        end
    }
}

impl Read for PartialFile {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.at >= self.shared.size.get() || into.is_empty() {
            return Ok(0);
        }
        let parts = self.shared.parts.borrow();
        let Some(part) = parts
            .iter()
            .find(|part| part.from <= self.at && self.at < part.end())
        else {
            self.shared.missing.set(Some(self.at));
            return Err(io::Error::other("a part is missing"));
        };
        let rest = &part.bytes[(self.at - part.from) as usize..];
        let length = rest.len().min(into.len());
        into[..length].copy_from_slice(&rest[..length]);
        self.shared.from.set(self.at);
        self.at += length as u64;
        self.shared.to.set(self.at);
        self.shared.until.set(part.end());
        Ok(length)
    }
}

impl Seek for PartialFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let place = match to {
            SeekFrom::Start(place) => Some(place),
            SeekFrom::End(by) => self.shared.size.get().checked_add_signed(by),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
        };
        self.at = place.ok_or_else(|| io::Error::other("a place before the file"))?;
        Ok(self.at)
    }
}
