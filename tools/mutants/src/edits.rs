//! Texts to insert into a source, and texts to replace there.

use std::ops::Range;

/// Edits of one source. Those at the same place keep the order in which they came.
pub struct Edits<'a> {
    source: &'a str,
    edits: Vec<(Range<usize>, String)>,
}

impl<'a> Edits<'a> {
    pub fn new(source: &'a str) -> Self {
        Self {
            source,
            edits: Vec::new(),
        }
    }

    /// The source's own text of a range.
    pub fn text(&self, range: Range<usize>) -> &'a str {
        &self.source[range]
    }

    pub fn insert(&mut self, place: usize, text: String) {
        self.edits.push((place..place, text));
    }

    /// The source with all edits.
    pub fn apply(mut self) -> String {
        self.edits.sort_by_key(|(range, _)| range.start);
        let mut changed = String::new();
        let mut end = 0;
        for (range, text) in &self.edits {
            changed.push_str(&self.source[end..range.start]);
            changed.push_str(text);
            end = range.end;
        }
        changed.push_str(&self.source[end..]);
        changed
    }
}
