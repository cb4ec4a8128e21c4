//! One scan of an E57 file.

use e57::{E57Reader, PointCloud, PointCloudReaderRaw, RecordDataType};

use crate::columns::{Axes, Column, axes_of, columns_of};
use crate::partial_file::PartialFile;

/// A packet has at most 64 kB, and a point may need several of them.
const AHEAD: u64 = 1 << 20;
/// So many rows are read at a time.
const BATCH: usize = 16_384;

pub struct Scan {
    /// It borrows `file`, and is gone before it.
    rows: Option<PointCloudReaderRaw<'static, PartialFile>>,
    file: *mut E57Reader<PartialFile>,
    parts: PartialFile,
    pose: Pose,
    axes: Axes,
    invalid: Option<usize>,
    columns: Vec<Column>,
    types: Vec<RecordDataType>,
    left: u64,
    promised: u64,
    /// Why the next point cannot be read.
    failed: Option<String>,
    /// Where the next part of the file begins: another scan, or the description.
    end: u64,
}

impl Scan {
    pub fn new(parts: PartialFile, index: usize) -> Result<Self, String> {
        let reader = E57Reader::new(parts.clone()).map_err(|error| error.to_string())?;
        let clouds = reader.pointclouds();
        let cloud = clouds.get(index).ok_or("there is no such scan")?;
        let (axes, invalid) = axes_of(cloud)?;
        if !cloud
            .prototype
            .iter()
            .any(|record| varies(&record.data_type))
        {
            return Err("the numbers of all points of a scan are the same".into());
        }
        let starts = clouds
            .iter()
            .map(|other| other.file_offset)
            .chain([reader.header().phys_xml_offset]);
        let mut scan = Self {
            rows: None,
            end: starts
                .filter(|&start| start > cloud.file_offset)
                .min()
                .unwrap_or(u64::MAX),
            file: Box::into_raw(Box::new(reader)),
            parts,
            pose: Pose::of(cloud)?,
            axes,
            invalid,
            columns: columns_of(cloud),
            types: cloud
                .prototype
                .iter()
                .map(|record| record.data_type.clone())
                .collect(),
            left: cloud.records,
            promised: cloud.records,
            failed: None,
        };
        // SAFETY: the file stays in its place until `drop`, which ends this borrow first.
        let rows = unsafe { &mut *scan.file }.pointcloud_raw(cloud);
        scan.rows = Some(rows.map_err(|error| error.to_string())?);
        Ok(scan)
    }

    /// Appends x, y, z and the columns of the next points. Returns how many there are; fewer if a part is missing. Points
    /// before a damaged place come first, and then the error.
    pub fn read(&mut self, into: &mut Vec<f64>) -> Result<usize, String> {
        if let Some(says) = self.failed.take() {
            return Err(says);
        }
        for count in 0..BATCH {
            if self.left == 0 || !self.parts.has_ahead(AHEAD) {
                return Ok(count);
            }
            let length = into.len();
            if let Err(says) = self.read_one(into) {
                into.truncate(length);
                if count == 0 {
                    return Err(says);
                }
                self.failed = Some(says);
                return Ok(count);
            }
            self.left -= 1;
        }
        Ok(BATCH)
    }

    fn read_one(&mut self, into: &mut Vec<f64>) -> Result<(), String> {
        let rows = self.rows.as_mut().ok_or("the scan has ended")?;
        let fields = rows.next().ok_or("the scan has ended")?;
        if self.parts.last_read() >= self.end {
            let read = self.promised - self.left;
            return Err(format!(
                "it ends after {read} of the {} points that it promises",
                self.promised
            ));
        }
        let fields = fields.map_err(|error| error.to_string())?;
        let number = |field: usize| fields[field].to_f64(&self.types[field]);
        let is_point = match self.invalid {
            Some(field) => number(field).is_ok_and(|state| state == 0.0),
            None => true,
        };
        let (Axes::Cartesian(places) | Axes::Polar(places)) = &self.axes;
        let [a, b, c] = places.map(|place| number(place).unwrap_or(f64::NAN));
        let position = match self.axes {
            _ if !is_point => [f64::NAN; 3],
            Axes::Cartesian(_) => [a, b, c],
            Axes::Polar(_) => [a * c.cos() * b.cos(), a * c.cos() * b.sin(), a * c.sin()],
        };
        into.extend(self.pose.placed(position));
        for column in &self.columns {
            into.push(
                column
                    .value(&fields, &self.types)
                    .map_err(|error| error.to_string())?,
            );
        }
        Ok(())
    }
}

impl Drop for Scan {
    fn drop(&mut self) {
        self.rows = None;
        // SAFETY: `new` made it with `Box::into_raw`, and nothing borrows it any more.
        drop(unsafe { Box::from_raw(self.file) });
    }
}

/// x, y and z of the place of a scan; 1 if it surely is the scanner's; 1 if single precision holds its positions.
pub fn facts_of(cloud: &PointCloud) -> Result<[f64; 5], String> {
    let (axes, _) = axes_of(cloud)?;
    let pose = Pose::of(cloud)?;
    let is_own = !pose.is_identity() || matches!(axes, Axes::Polar(_)) || cloud.has_row_column();
    let is_single = match axes {
        Axes::Cartesian(places) => places.iter().all(|&place| {
            matches!(
                cloud.prototype[place].data_type,
                RecordDataType::Single { .. }
            ) && pose.is_identity()
        }),
        Axes::Polar(_) => false,
    };
    let [x, y, z] = pose.placed([0.0; 3]);
    Ok([
        x,
        y,
        z,
        f64::from(u8::from(is_own)),
        f64::from(u8::from(is_single)),
    ])
}

/// Whether a type of numbers takes space in the file.
fn varies(data: &RecordDataType) -> bool {
    match data {
        RecordDataType::Integer { min, max } | RecordDataType::ScaledInteger { min, max, .. } => {
            min < max
        }
        _ => true,
    }
}

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
