//! Makes one answer for a cloud in parts from the answers of the parts.

use alloc::vec::Vec;

use crate::base::allocation::with_capacity;
use crate::base::error::Error;
use crate::base::sort::sort_keyed;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::{Given, Points, Position, checked_len};
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::refusals::QuestionKind;

/// Which points of a cloud are visible, given the visible points of its parts?
///
/// A point that its own part hides is hidden in the whole cloud. A hidden point hides only
/// points that visible points hide too. So with one viewpoint and one radius,
/// visible(A ∪ B) = visible(visible(A) ∪ visible(B)), exactly. Each part can be asked where it
/// is stored. Only its visible points are brought together.
///
/// A part is a list of positions and a list of ids, one id for each position. The caller
/// chooses the ids. A part holds at least the points that are visible in that part from
/// `viewpoint` with the radius of `options`. Equal positions share one answer, also across
/// parts. Returns the ids of the visible points, ascending, each once.
///
/// ```
/// use hidden_point_removal::{Options, PointCloud, merge_visible};
///
/// let tiles = [[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]], [[0.0, 0.0, 2.0], [1.0, 0.0, 0.0]]];
/// let first_ids = [10, 20];
/// let viewpoint = [0.0, 0.0, 5.0];
/// let options = Options::radius(100.0);
///
/// let mut parts = Vec::new();
/// for (tile, first_id) in tiles.iter().zip(first_ids) {
///     let seen = PointCloud::new(tile)?.visible_from(viewpoint, &options)?;
///     let positions: Vec<_> = seen.indices().iter().map(|&i| tile[i as usize]).collect();
///     let ids: Vec<_> = seen.indices().iter().map(|&i| first_id + i).collect();
///     parts.push((positions, ids));
/// }
/// let parts: Vec<_> = parts.iter().map(|(p, ids)| (&p[..], &ids[..])).collect();
/// // Each tile hides a point of the other.
/// assert_eq!(merge_visible(&parts, viewpoint, &options)?, [11, 20]);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
///
/// # Errors
/// [`Error::MergeRadius`] unless the radius is [`Radius::Absolute`], or the inversion
/// an [`Exponential::Scale`];
/// [`Error::Excludes`] for [`Inversion::Looks`] and [`Options::within`];
/// [`Error::IdsLength`]; those of [`PointCloud::new`] for all positions together (an
/// index counts through all parts) and of [`PointCloud::visible_from`].
pub fn merge_visible<P: Position>(
    parts: &[(&[P], &[u32])],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<u32>, Error> {
    let part = |part| {
        let (positions, ids): (&[P], _) = parts[part];
        (P::given(positions), Ids::Short(ids))
    };
    merge(parts.len(), &part, viewpoint, options)
}

/// The same as [`merge_visible`], with ids beyond 2³².
///
/// # Errors
/// As [`merge_visible`].
pub fn merge_visible_u64<P: Position>(
    parts: &[(&[P], &[u64])],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<u64>, Error> {
    let part = |part| {
        let (positions, ids): (&[P], _) = parts[part];
        (P::given(positions), Ids::Long(ids))
    };
    let seen = merge_keyed(parts.len(), &part, viewpoint, options)?;
    let mut ids = with_capacity(seen.len())?;
    ids.extend(seen.iter().map(|&(id, _)| id));
    Ok(ids)
}

/// The ids of the points of a part.
#[derive(Clone, Copy)]
pub(crate) enum Ids<'a> {
    Short(&'a [u32]),
    Long(&'a [u64]),
}

impl Ids<'_> {
    fn len(self) -> usize {
        match self {
            Self::Short(ids) => ids.len(),
            Self::Long(ids) => ids.len(),
        }
    }

    fn get(self, index: usize) -> u64 {
        match self {
            Self::Short(ids) => u64::from(ids[index]),
            Self::Long(ids) => ids[index],
        }
    }
}

/// The same as [`merge_visible`], for parts in the same precision. The ids are short.
pub(crate) fn merge<'a>(
    parts: usize,
    part: &dyn Fn(usize) -> (Given<'a>, Ids<'a>),
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<u32>, Error> {
    let seen = merge_keyed(parts, part, viewpoint, options)?;
    let mut ids = with_capacity(seen.len())?;
    ids.extend(seen.iter().map(|&(id, _)| id as u32));
    Ok(ids)
}

/// The ids of the visible points, ascending, each once and with the number of a point.
#[inline(never)]
fn merge_keyed<'a>(
    parts: usize,
    part: &dyn Fn(usize) -> (Given<'a>, Ids<'a>),
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<(u64, u32)>, Error> {
    check_mergeable(options)?;
    let mut count = 0usize;
    for number in 0..parts {
        let (positions, ids) = part(number);
        let (positions, ids) = (positions.len(), ids.len());
        if positions != ids {
            return Err(Error::IdsLength {
                part: number,
                positions,
                ids,
            });
        }
        count = count.saturating_add(positions);
    }
    let count = checked_len(count)?;
    let precision = match parts {
        0 => Given::Single(&[]),
        _ => part(0).0,
    };
    let mut positions = Points::with_capacity(count, precision)?;
    for number in 0..parts {
        let (given, _) = part(number);
        positions.extend(given, 0..given.len());
    }
    let cloud = PointCloud::prepare(positions.as_given(), NonFinite::Error, &mut |_| ())?;
    drop(positions);
    let visible = cloud.visible_from(viewpoint, options)?;
    drop(cloud);

    let mut seen = with_capacity(visible.count())?;
    let (mut number, mut start) = (0, 0);
    for &k in visible.indices() {
        let mut ids = part(number).1;
        while k as usize - start >= ids.len() {
            start += ids.len();
            number += 1;
            ids = part(number).1;
        }
        seen.push((ids.get(k as usize - start), k));
    }
    drop(visible);
    sort_keyed(&mut seen);
    seen.dedup_by_key(|&mut (id, _)| id);
    Ok(seen)
}

/// Refuses options for which the answer of the parts would not be the answer of the whole.
#[inline(never)]
pub(crate) fn check_mergeable(options: &Options) -> Result<(), Error> {
    options.check(QuestionKind::Merge)?;
    // Any other radius would depend on the points that are left in the parts.
    let resolved = match options.inversion {
        Inversion::Spherical | Inversion::Power(_) => {
            matches!(options.radius, Radius::Absolute(_))
        }
        Inversion::Exponential(scale) => scale != Exponential::Auto,
        Inversion::Looks(_) => false,
    };
    if !resolved {
        return Err(Error::MergeRadius);
    }
    Ok(())
}
