//! The inversion: how a point moves away from the viewpoint (paper §3, eq. 1).

pub(crate) mod inversion;
pub(crate) mod kernel;
