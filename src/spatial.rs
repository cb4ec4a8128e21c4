//! The order in which a cloud keeps its points: along a 3D Hilbert curve.
//!
//! Neighbors on the curve are neighbors in space, so walks on the hull are
//! short and memory is read in runs. The order depends on the set of points
//! alone (ties on the curve are broken by coordinates), never on the order of
//! the input, so everything computed in it is reproducible to the bit.

/// Bits per axis; three axes fill 63 bits of the key.
const BITS: u32 = 21;
/// Cells along an axis.
const CELLS: f64 = (1u32 << BITS) as f64;

/// Axis-aligned bounding box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

impl Bounds {
    pub(crate) const EMPTY: Self = Self {
        min: [f64::INFINITY; 3],
        max: [f64::NEG_INFINITY; 3],
    };

    pub(crate) fn include(&mut self, p: [f64; 3]) {
        for axis in 0..3 {
            self.min[axis] = self.min[axis].min(p[axis]);
            self.max[axis] = self.max[axis].max(p[axis]);
        }
    }

    pub(crate) fn union(&mut self, other: &Self) {
        for axis in 0..3 {
            self.min[axis] = self.min[axis].min(other.min[axis]);
            self.max[axis] = self.max[axis].max(other.max[axis]);
        }
    }

    /// Squared distance from `p` to the box, 0 inside.
    pub(crate) fn distance_squared(&self, p: [f64; 3]) -> f64 {
        let mut sum = 0.0;
        for axis in 0..3 {
            let gap = (self.min[axis] - p[axis])
                .max(p[axis] - self.max[axis])
                .max(0.0);
            sum += gap * gap;
        }
        sum
    }
}

/// Maps points of a box to their place on the Hilbert curve through its cube.
pub(crate) struct HilbertCurve {
    min: [f64; 3],
    half_extent: f64,
}

impl HilbertCurve {
    pub(crate) fn new(bounds: &Bounds) -> Self {
        // Halves, because the full extent of a finite box can overflow.
        let mut half_extent = 0.0f64;
        for axis in 0..3 {
            half_extent = half_extent.max(bounds.max[axis] * 0.5 - bounds.min[axis] * 0.5);
        }
        Self {
            min: bounds.min,
            half_extent,
        }
    }

    /// The key of `p` among all points; equal points have equal keys.
    pub(crate) fn key(&self, p: [f64; 3]) -> u64 {
        interleave(to_hilbert(self.cells(p).map(cell)))
    }

    /// The key of `p` among the points of one cell, along a curve of its own: a
    /// single far point can make the box so large that all others share a few cells.
    pub(crate) fn key_in_cell(&self, p: [f64; 3]) -> u64 {
        let inside = |cells: f64| cell((cells - f64::from(cell(cells))) * CELLS);
        interleave(to_hilbert(self.cells(p).map(inside)))
    }

    /// How many cells away from the corner of the box `p` is along each axis.
    fn cells(&self, p: [f64; 3]) -> [f64; 3] {
        if self.half_extent == 0.0 {
            return [0.0; 3];
        }
        let along = |axis: usize| (p[axis] * 0.5 - self.min[axis] * 0.5) / self.half_extent;
        core::array::from_fn(|axis| along(axis) * CELLS)
    }
}

/// The number of the cell; the far side of the box belongs to the last one.
fn cell(cells: f64) -> u32 {
    // `as` saturates.
    (cells as u32).min((1 << BITS) - 1)
}

/// Skilling's transform ("Programming the Hilbert curve", 2004): coordinates to
/// the transposed Hilbert index, whose interleaved bits are the key.
fn to_hilbert(mut x: [u32; 3]) -> [u32; 3] {
    let mut bit = 1 << (BITS - 1);
    while bit > 1 {
        let below = bit - 1;
        for axis in 0..3 {
            if x[axis] & bit != 0 {
                x[0] ^= below;
            } else {
                let swap = (x[0] ^ x[axis]) & below;
                x[0] ^= swap;
                x[axis] ^= swap;
            }
        }
        bit >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut gray = 0;
    let mut bit = 1 << (BITS - 1);
    while bit > 1 {
        if x[2] & bit != 0 {
            gray ^= bit - 1;
        }
        bit >>= 1;
    }
    x.map(|axis| axis ^ gray)
}

fn interleave(x: [u32; 3]) -> u64 {
    spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2])
}

/// Puts two zero bits between any two of the low 21 bits.
fn spread(x: u32) -> u64 {
    let mut x = u64::from(x);
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// Sorts points by their coordinates, equal ones by index. Coordinates hold no -0.
pub(crate) fn sort_by_coordinates(points: &mut [([f64; 3], u32)]) {
    points.sort_unstable_by(|(a, i), (b, j)| {
        a[0].total_cmp(&b[0])
            .then(a[1].total_cmp(&b[1]))
            .then(a[2].total_cmp(&b[2]))
            .then(i.cmp(j))
    });
}
