//! What this build of the crate holds.

/// False in the small module of the npm package, which holds the operator alone. Only code that the
/// linker would keep asks for it.
pub(crate) const FULL: bool = cfg!(any(feature = "wasm", not(feature = "lite")));
