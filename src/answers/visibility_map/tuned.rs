//! How sharp a map may be that stands in for looks.
//!
//! Looks show points that no single hull shows, and more of them where a surface is thick. So the
//! scale of a map is found by trial, once for a cloud: the largest one at which maps hide hardly any
//! point that the looks show from four viewpoints around the middle.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::looks::{Projection, Question};
use crate::answers::memory::ViewMemory;
use crate::answers::visibility_map::Asked;
use crate::answers::visibility_map::kept::Tuned;
use crate::answers::visibility_map::pool::Cone;
use crate::base::allocation::push;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;

/// The looks at more points than this are taken at an even sample.
const MOST: usize = 50_000;
/// The share of the points shown by looks that a map may hide, from each of four viewpoints. From others
/// it can be several times as large.
const WRONG: f64 = 0.001;
/// The largest factor of the scale, the least one, and the step between factors.
const FACTORS: [f64; 2] = [16.0, 1.0 / 64.0];
const STEP: f64 = 0.7;

impl PointCloud {
    /// The factor by which the scale of the last look may grow.
    pub(super) fn tuned(
        &self,
        memory: &mut ViewMemory,
        asked: &Asked,
        count: usize,
    ) -> Result<f64, Error> {
        let thickness = asked.options.thickness;
        if let Some(known) = &memory.maps.tuned
            && known.count == count
            && known.thickness == thickness
        {
            return Ok(known.larger);
        }
        let sample = self.sample(MOST)?;
        let looked = sample.as_ref().unwrap_or(self);
        let mut larger = FACTORS[0];
        for viewpoint in self.around(asked.viewpoint) {
            let asked = Asked {
                viewpoint,
                ..*asked
            };
            let shown = looked.shown_by_looks(&asked, count)?;
            let mut is_safe = |larger| {
                let map = self.mapped(memory, &asked, larger)?;
                let hidden = shown.iter().filter(|&&point| map.hides(point)).count();
                Ok::<_, Error>(hidden as f64 <= WRONG * shown.len() as f64)
            };
            // The second map is the first one that is chosen by a map.
            is_safe(larger)?;
            while larger > FACTORS[1] && !is_safe(larger)? {
                larger *= STEP;
            }
        }
        memory.maps.tuned = Some(Tuned {
            count,
            thickness,
            larger,
        });
        Ok(larger)
    }

    /// A viewpoint, and three others as far from the middle, evenly around it.
    fn around(&self, viewpoint: [f64; 3]) -> [[f64; 3]; 4] {
        let middle = DVec3::from_array(self.middle());
        let [x, y, z] = (DVec3::from_array(viewpoint) - middle).to_array();
        // The quarter turns and mirrors of a cube's corner are those of a tetrahedron.
        let others = [[x, -y, -z], [-x, y, -z], [-x, -y, z]];
        let mut all = [viewpoint; 4];
        for (to, other) in all[1..].iter_mut().zip(others) {
            *to = (middle + DVec3::from_array(other)).to_array();
        }
        all
    }

    /// The points that looks show in the directions that are asked for.
    fn shown_by_looks(&self, asked: &Asked, count: usize) -> Result<Vec<[f64; 3]>, Error> {
        let question = Question {
            projection: Projection::Perspective(asked.viewpoint),
            count,
            with_scores: false,
            thickness: asked.options.thickness,
        };
        let seen = ViewMemory::default().look(self, question)?;
        let cone = Cone::of(asked.map);
        let viewpoint = DVec3::from_array(asked.viewpoint);
        let mut shown = Vec::new();
        for (point, visible) in self.sequence.points.iter().zip(seen.visible) {
            let is_asked = |cone: &Cone| cone.contains(DVec3::from_array(point) - viewpoint);
            if visible && cone.as_ref().is_none_or(is_asked) {
                push(&mut shown, point)?;
            }
        }
        Ok(shown)
    }
}
