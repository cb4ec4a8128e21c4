//! Which numbers of a scan are positions, colors and other columns.

use e57::{PointCloud, RecordDataType, RecordName, RecordValue};

/// A column of the cloud besides x, y and z.
pub struct Column {
    pub name: String,
    /// The type of its numbers: u1, i2, f4, …
    pub kind: &'static str,
    field: usize,
    /// For colors: the numbers that are black and full.
    range: Option<(f64, f64)>,
}

impl Column {
    pub fn value(
        &self,
        fields: &[RecordValue],
        types: &[RecordDataType],
    ) -> Result<f64, e57::Error> {
        let value = fields[self.field].to_f64(&types[self.field])?;
        Ok(match self.range {
            Some((low, high)) => (255.0 * (value - low) / (high - low))
                .round()
                .clamp(0.0, 255.0),
            None => value,
        })
    }
}

/// The places of three numbers of a position.
pub enum Axes {
    Cartesian([usize; 3]),
    /// The range, the azimuth and the elevation.
    Polar([usize; 3]),
}

/// Where a position is, and where it says that it is none.
pub fn axes_of(cloud: &PointCloud) -> Result<(Axes, Option<usize>), String> {
    use RecordName::*;
    let place = |name| {
        cloud
            .prototype
            .iter()
            .position(|record| record.name == name)
    };
    let places = |names: [RecordName; 3]| {
        let [a, b, c] = names.map(place);
        Some([a?, b?, c?])
    };
    if let Some(axes) = places([CartesianX, CartesianY, CartesianZ]) {
        return Ok((Axes::Cartesian(axes), place(CartesianInvalidState)));
    }
    let axes = places([SphericalRange, SphericalAzimuth, SphericalElevation]);
    let axes = axes.ok_or(
        "a scan has neither cartesianX, cartesianY, cartesianZ nor three spherical coordinates",
    )?;
    Ok((Axes::Polar(axes), place(SphericalInvalidState)))
}

pub fn columns_of(cloud: &PointCloud) -> Vec<Column> {
    let records = cloud.prototype.iter().enumerate();
    records
        .filter_map(|(field, record)| column_of(cloud, field, &record.name, &record.data_type))
        .collect()
}

fn column_of(
    cloud: &PointCloud,
    field: usize,
    name: &RecordName,
    data: &RecordDataType,
) -> Option<Column> {
    use RecordName::*;
    let limits = cloud.color_limits.as_ref();
    let color = |name: &str, low: Option<&RecordValue>, high: Option<&RecordValue>| {
        let limit = |value: Option<&RecordValue>| value.and_then(|value| value.to_f64(data).ok());
        let range = limit(low)
            .zip(limit(high))
            .or_else(|| range_of(data))
            .unwrap_or((0.0, 255.0));
        let range = Some(if range.1 > range.0 {
            range
        } else {
            (0.0, 255.0)
        });
        Some(Column {
            name: name.into(),
            kind: "u1",
            field,
            range,
        })
    };
    let other = |name: &str| {
        Some(Column {
            name: name.into(),
            kind: kind_of(data),
            field,
            range: None,
        })
    };
    match name {
        CartesianX | CartesianY | CartesianZ | CartesianInvalidState => None,
        SphericalRange | SphericalAzimuth | SphericalElevation | SphericalInvalidState => None,
        ColorRed => color(
            "red",
            limits.and_then(|all| all.red_min.as_ref()),
            limits.and_then(|all| all.red_max.as_ref()),
        ),
        ColorGreen => color(
            "green",
            limits.and_then(|all| all.green_min.as_ref()),
            limits.and_then(|all| all.green_max.as_ref()),
        ),
        ColorBlue => color(
            "blue",
            limits.and_then(|all| all.blue_min.as_ref()),
            limits.and_then(|all| all.blue_max.as_ref()),
        ),
        Intensity => other("intensity"),
        IsIntensityInvalid => other("isIntensityInvalid"),
        IsColorInvalid => other("isColorInvalid"),
        RowIndex => other("rowIndex"),
        ColumnIndex => other("columnIndex"),
        ReturnCount => other("returnCount"),
        ReturnIndex => other("returnIndex"),
        TimeStamp => other("timeStamp"),
        IsTimeStampInvalid => other("isTimeStampInvalid"),
        Unknown { name, .. } => other(name),
    }
}

/// The numbers that a type can hold. Full colors in floats are 1.
fn range_of(data: &RecordDataType) -> Option<(f64, f64)> {
    match data {
        RecordDataType::Single { min, max } => {
            Some((min.unwrap_or(0.0).into(), max.unwrap_or(1.0).into()))
        }
        RecordDataType::Double { min, max } => Some((min.unwrap_or(0.0), max.unwrap_or(1.0))),
        RecordDataType::Integer { min: i64::MIN, .. }
        | RecordDataType::Integer { max: i64::MAX, .. } => None,
        RecordDataType::Integer { min, max } => Some((*min as f64, *max as f64)),
        RecordDataType::ScaledInteger {
            min,
            max,
            scale,
            offset,
        } => Some((*min as f64 * scale + offset, *max as f64 * scale + offset)),
    }
}

fn kind_of(data: &RecordDataType) -> &'static str {
    let RecordDataType::Integer { min, max } = data else {
        return if matches!(data, RecordDataType::Single { .. }) {
            "f4"
        } else {
            "f8"
        };
    };
    match (min, max) {
        (0.., ..=0xff) => "u1",
        (-0x80.., ..=0x7f) => "i1",
        (0.., ..=0xffff) => "u2",
        (-0x8000.., ..=0x7fff) => "i2",
        (0.., ..=0xffff_ffff) => "u4",
        (-0x8000_0000.., ..=0x7fff_ffff) => "i4",
        _ => "f8",
    }
}
