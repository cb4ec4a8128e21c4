//! The number of a sector.

/// One of several sectors that a view is divided into.
///
/// Each sector can be asked in a thread of its own. It needs nothing from the others. See
/// [`PointCloud::visible_in_sector`](crate::PointCloud::visible_in_sector).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sector {
    pub(crate) number: u32,
    pub(crate) count: u32,
}

impl Sector {
    /// The one sector of a view that is not divided.
    #[cfg(feature = "lite")]
    pub(crate) const WHOLE: Self = Self {
        number: 0,
        count: 1,
    };

    /// Sector `number` of `count`; `None` unless `number` is below `count`.
    #[must_use]
    pub fn new(number: u32, count: u32) -> Option<Self> {
        (number < count).then_some(Self { number, count })
    }
}
