//! Compares a divided view with the view as a whole.

use hidden_point_removal::{Options, PointCloud, Sector};

/// Compares the answers of all sectors together with the cloud's single answer. Returns how
/// many points each sector answered for (none if the view is refused), or the difference.
pub fn compare(
    cloud: &PointCloud,
    viewpoint: [f64; 3],
    options: &Options,
    count: u32,
) -> Result<Vec<usize>, String> {
    let whole = cloud.visible_from(viewpoint, options);
    let mut all = Vec::new();
    let mut counts = Vec::new();
    for number in 0..count {
        let sector = Sector::new(number, count).expect("a number below the count");
        match (&whole, cloud.visible_in_sector(viewpoint, options, sector)) {
            (Ok(whole), Ok(part)) => {
                let bits = |x: f64, y: f64| x.to_bits() == y.to_bits();
                if !bits(part.radius(), whole.radius()) || !bits(part.exponent(), whole.exponent())
                {
                    return Err(format!("sector {number} has another radius"));
                }
                if !part.indices().is_sorted_by(|a, b| a < b) {
                    return Err(format!("the indices of sector {number} do not ascend"));
                }
                counts.push(part.count());
                all.extend(part.into_indices());
            }
            (Err(whole), Err(part)) if whole.to_string() == part.to_string() => {}
            (whole, part) => {
                let [whole, part] = [whole.as_ref().err(), part.as_ref().err()];
                return Err(format!("refused: {whole:?}, sector {number}: {part:?}"));
            }
        }
    }
    let Ok(whole) = whole else {
        return Ok(counts);
    };
    all.sort_unstable();
    if all == whole.indices() {
        return Ok(counts);
    }
    let only = |these: &[u32], others: &[u32]| -> Vec<u32> {
        let missing = |i: &&u32| others.binary_search(i).is_err();
        these.iter().filter(missing).copied().take(10).collect()
    };
    Err(format!(
        "{count} sectors: {} visible, {} in the whole; only in sectors {:?}, only in the whole {:?}",
        all.len(),
        whole.count(),
        only(&all, whole.indices()),
        only(whole.indices(), &all)
    ))
}
