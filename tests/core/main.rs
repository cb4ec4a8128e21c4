//! Compares the core with its definition.

mod checks;
mod common;
mod short;

mod automatic;
mod calibration;
mod camera;
mod changes;
mod coverage;
mod direction;
mod fixtures;
mod guarantees;
mod horizon;
mod hyperspace;
mod illumination;
mod inversions;
mod looks;
mod looks_scanned;
mod looks_thick;
mod looks_uneven;
mod maps;
mod merge;
mod modes;
mod opposite;
mod oracle;
mod panorama;
mod radius;
mod reconstruct;
mod refusals;
mod same_bits;
#[cfg(not(target_family = "wasm"))]
mod scanned_clouds;
#[cfg(not(target_family = "wasm"))]
#[path = "common/scans.rs"]
mod scans;
mod scores;
mod sectors;
mod sees;
mod slices;
mod transfer;
mod union;
mod within;

// A file that uses this attribute runs natively and in WebAssembly.
#[cfg(not(target_family = "wasm"))]
use core::prelude::v1::test;
#[cfg(target_family = "wasm")]
use wasm_bindgen_test::wasm_bindgen_test as test;
