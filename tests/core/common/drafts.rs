//! Checks for one view that its draft keeps the promises of drafts.

use hidden_point_removal::{Error, Observer, Options, PointCloud, Visibility};

/// Asks an observer for the draft of a view, and then for the exact answer that goes on from the
/// draft. Returns the first fault of either, if there is one.
pub fn fault(
    cloud: &PointCloud,
    observer: &mut Observer,
    viewpoint: [f64; 3],
    options: &Options,
) -> Option<String> {
    let asked = options.draft(true);
    let draft = observer.visible_from(viewpoint, &asked);
    let exact = observer.visible_from(viewpoint, options);
    let cold = cloud.visible_from(viewpoint, options);
    let (draft, exact, cold) = match (draft, exact, cold) {
        (Ok(draft), Ok(exact), Ok(cold)) => (draft, exact, cold),
        (Err(draft), Err(exact), Err(cold))
            if [&draft, &exact].map(|e| e.to_string()) == [&cold, &cold].map(|e| e.to_string()) =>
        {
            return None;
        }
        (draft, exact, cold) => {
            let answers = [draft, exact, cold].map(|answer| answer.map(|seen| seen.count()));
            return Some(format!("draft, exact, cold: {answers:?}"));
        }
    };
    if exact != cold || !exact.exact() {
        return Some(format!(
            "{} visible after the draft, {} cold",
            exact.count(),
            cold.count()
        ));
    }
    if draft.exact() || resolved(&draft) != resolved(&cold) {
        return Some(format!("the draft says {:?}", resolved(&draft)));
    }
    let again = cloud.visible_from(viewpoint, &asked);
    if again.as_ref() != Ok(&draft) {
        let again = again.map(|seen| seen.count());
        return Some(format!("drafts of {} and {again:?}", draft.count()));
    }
    let sliced = in_slices(observer, viewpoint, options, &draft, 1 + cloud.len() / 3);
    if sliced.as_ref() != Ok(&cold) {
        let sliced = sliced.map(|seen| seen.count());
        return Some(format!("{} cold, in slices {sliced:?}", cold.count()));
    }
    let mask = draft.mask();
    let lost = |&&index: &&u32| mask[index as usize] == 0;
    let lost: Vec<&u32> = cold.indices().iter().filter(lost).collect();
    (!lost.is_empty()).then(|| {
        let first = &lost[..lost.len().min(10)];
        format!(
            "{} visible points hidden, the first are {first:?}",
            lost.len()
        )
    })
}

/// The exact answer, which goes on from a draft in slices of about `budget` points. In between,
/// the draft is asked again, and must be the same.
fn in_slices(
    observer: &mut Observer,
    viewpoint: [f64; 3],
    options: &Options,
    draft: &Visibility,
    budget: usize,
) -> Result<Visibility, Error> {
    let asked = options.draft(true);
    observer.visible_from(viewpoint, &asked)?;
    observer.go_on(viewpoint, options, budget)?;
    assert_eq!(&observer.visible_from(viewpoint, &asked)?, draft);
    let mut slices = 0;
    while !observer.go_on(viewpoint, options, budget)? {
        slices += 1;
        assert!(slices < 10, "the slices do not end");
    }
    observer.visible_from(viewpoint, options)
}

fn resolved(seen: &Visibility) -> (u64, u64, u32, String) {
    let inversion = format!("{:?}", seen.inversion());
    let (radius, exponent) = (seen.radius().to_bits(), seen.exponent().to_bits());
    (radius, exponent, seen.evaluations(), inversion)
}
