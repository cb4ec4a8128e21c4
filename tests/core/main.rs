//! The core against its definition: the same tests run natively
//! (`cargo test --release --test core`) and, compiled to WebAssembly, under Node.

mod common;

mod automatic;
mod certificates;
mod changes;
mod definition;
mod digest;
mod fixtures;
mod invariance;
mod merge;
mod motion;
mod oracle;
mod radius;
mod refusals;
mod sectors;
