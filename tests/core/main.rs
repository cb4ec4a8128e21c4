//! Compares the core with its definition.

mod checks;
mod common;
mod short;

mod automatic;
mod camera;
mod changes;
mod coverage;
mod definition;
mod direction;
mod draft;
mod fixtures;
mod guarantees;
mod horizon;
mod hyperspace;
mod illumination;
mod inversions;
mod looks;
mod looks_along;
mod looks_in_steps;
mod looks_scanned;
mod looks_thick;
mod looks_uneven;
mod maps;
mod merge;
mod noise;
mod oracle;
mod panorama;
mod plane;
mod radius;
mod reconstruct;
mod refusals;
mod same_bits;
mod scanned_clouds;
#[path = "common/scans.rs"]
mod scans;
mod search;
mod sectors;
mod sees;
mod share;
mod survivors;
mod thin;
mod threads;
mod union;
mod within;
