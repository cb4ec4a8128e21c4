//! Where a scan stands in the coordinates of its file.

use e57::PointCloud;

/// The rows of a rotation, and a translation.
pub struct Pose {
    rotation: [[f64; 3]; 3],
    translation: [f64; 3],
}

/// Longer or shorter quaternions turn nothing.
const LENGTHS: std::ops::Range<f64> = 0.99..1.01;

impl Pose {
    pub fn of(cloud: &PointCloud) -> Result<Self, String> {
        let Some(transform) = &cloud.transform else {
            return Ok(Self {
                rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                translation: [0.0; 3],
            });
        };
        let (turn, to) = (&transform.rotation, &transform.translation);
        let length = (turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z).sqrt();
        if !LENGTHS.contains(&length) || ![to.x, to.y, to.z].into_iter().all(f64::is_finite) {
            return Err("the pose of a scan is no rotation and translation".into());
        }
        let [w, x, y, z] = [turn.w, turn.x, turn.y, turn.z].map(|part| part / length);
        Ok(Self {
            rotation: [
                [
                    1.0 - 2.0 * (y * y + z * z),
                    2.0 * (x * y - w * z),
                    2.0 * (x * z + w * y),
                ],
                [
                    2.0 * (x * y + w * z),
                    1.0 - 2.0 * (x * x + z * z),
                    2.0 * (y * z - w * x),
                ],
                [
                    2.0 * (x * z - w * y),
                    2.0 * (y * z + w * x),
                    1.0 - 2.0 * (x * x + y * y),
                ],
            ],
            translation: [to.x, to.y, to.z],
        })
    }

    pub fn is_identity(&self) -> bool {
        self.placed([1.0, 2.0, 3.0]) == [1.0, 2.0, 3.0] && self.translation == [0.0; 3]
    }

    pub fn placed(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let [a, b, c] = self.rotation[axis];
            a * x + b * y + c * z + self.translation[axis]
        })
    }
}
