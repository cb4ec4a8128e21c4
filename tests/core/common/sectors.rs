//! Compares a view that threads share with the view of one.

use hidden_point_removal::{Options, PointCloud};

pub fn compare(
    cloud: &PointCloud,
    viewpoint: [f64; 3],
    options: &Options,
    threads: usize,
) -> Result<(), String> {
    let whole = cloud.visible_from(viewpoint, options);
    let shared = cloud.visible_from(viewpoint, &options.with_threads(threads));
    let text = |answer: &Result<_, _>| format!("{answer:?}");
    let (whole, shared) = match (whole, shared) {
        (Ok(whole), Ok(shared)) if whole == shared => return Ok(()),
        (Ok(whole), Ok(shared)) => (whole, shared),
        (whole, shared) if text(&whole) == text(&shared) => return Ok(()),
        (whole, shared) => {
            let [whole, shared] = [whole.err(), shared.err()];
            return Err(format!(
                "refused: {whole:?}, by {threads} threads: {shared:?}"
            ));
        }
    };
    let only = |these: &[u32], others: &[u32]| -> Vec<u32> {
        let missing = |i: &&u32| others.binary_search(i).is_err();
        these.iter().filter(missing).copied().take(10).collect()
    };
    let [seen, all] = [shared.indices(), whole.indices()];
    Err(format!(
        "{threads} threads: {} visible, {} by one; only by threads {:?}, only by one {:?}",
        seen.len(),
        all.len(),
        only(seen, all),
        only(all, seen)
    ))
}
