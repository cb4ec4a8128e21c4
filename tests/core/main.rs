//! Compares the core with its definition.

mod common;

mod automatic;
mod camera;
mod certificates;
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
mod invariance;
mod inversions;
mod looks;
mod looks_along;
mod looks_in_steps;
mod looks_thick;
mod looks_uneven;
mod maps;
mod merge;
mod noise;
mod oracle;
mod panorama;
mod plane;
mod queries;
mod radius;
mod reconstruct;
mod refusals;
mod search;
mod sectors;
mod sees;
mod share;
mod survivors;
mod thin;
#[cfg(feature = "std")]
mod threads;
mod union;
mod within;

#[path = "../fuzz/queries/mod.rs"]
mod kinds_of_queries;
