//! One view that several threads share.

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::square_root;
use crate::base::threads::{HAS_THREADS, deal};
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::division::{Division, Sector};
use crate::hull::{self, Memory};
use crate::view::options::Inversion;
use crate::view::resolved::View;
use alloc::vec::Vec;
use glam::DVec3;

impl PointCloud {
    /// The visible points of a view that `threads` threads share, one sector each. `None` if the
    /// view is not divided.
    pub(crate) fn marked_by(
        &self,
        threads: usize,
        viewpoint: [f64; 3],
        view: &View,
    ) -> Result<Option<Vec<bool>>, OutOfMemory> {
        let points = &self.sequence.points;
        let blocks = &self.blocks.levels[0];
        let count = if cfg!(debug_assertions) {
            // Tests divide small clouds, too: they have more seams for each point.
            threads
        } else {
            threads.min(blocks.len() / FEWEST_BLOCKS)
        };
        if !HAS_THREADS || count < 2 || !is_divisible(view) {
            return Ok(None);
        }
        let radius = view.chosen.radius;
        let sample = self.seen_sample(viewpoint, radius)?;
        let mut visible = filled(points.len(), false)?;
        let mark = |memory: &mut Memory, number: usize| -> Result<Vec<bool>, OutOfMemory> {
            let [number, count] = [number, count].map(|number| number as u32);
            let division = self.division(viewpoint, radius, &sample, Sector { number, count })?;
            hull::mark_sector(points, blocks, &view.flip, division, memory)?;
            Ok(memory.take_visible())
        };
        deal(count, count, &Memory::new, &mark, &mut |_, own| {
            for (visible, own) in visible.iter_mut().zip(own) {
                *visible |= own;
            }
        })?;
        Ok(Some(visible))
    }

    /// Which points of a sample are visible. This decides how the work is shared.
    fn seen_sample(&self, viewpoint: [f64; 3], radius: f64) -> Result<Vec<bool>, OutOfMemory> {
        let mut sample = with_capacity(self.blocks.levels[0].len())?;
        sample.extend(Division::sample(&self.blocks));
        let points = self.sequence.points.gathered(&sample)?;
        let center = DVec3::from_array(viewpoint);
        // Sparser points need a smaller sphere, as in the automatic radius.
        let sparser = square_root(points.len() as f64 / self.sequence.points.len() as f64);
        let mut coarse = radius * sparser;
        for point in points.iter() {
            let distance = (DVec3::from_array(point) - center).length();
            if distance > coarse {
                coarse = distance;
            }
        }
        let mut memory = Memory::new();
        let flip = Flip::new(viewpoint, Kernel::Spherical { radius: coarse });
        hull::mark_visible(&points, &[], &flip, &mut memory)?;
        Ok(memory.take_visible())
    }

    fn division(
        &self,
        viewpoint: [f64; 3],
        radius: f64,
        sample: &[bool],
        sector: Sector,
    ) -> Result<Division, OutOfMemory> {
        Division::new(
            &self.sequence.points,
            &self.blocks,
            DVec3::from_array(viewpoint),
            radius,
            sample,
            sector,
        )
    }
}

/// The fewest blocks of points for each thread. To start a thread takes as long as to decide about
/// some hundred points.
const FEWEST_BLOCKS: usize = 16;

/// Whether bounds of flipped points are known and useful. They are not useful where squares
/// overflow or underflow, nor where 2R − d keeps too few digits of d.
fn is_divisible(view: &View) -> bool {
    view.inversion == Inversion::Spherical
        && (1e-29..1e29).contains(&view.chosen.radius)
        && view.chosen.exponent < 8.0
}
