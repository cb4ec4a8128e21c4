//! What `help()` shows of every question to a cloud.

/// The signature of a question that takes the options of a view, in the form in which Python reads it from a docstring.
/// Inside, the options are one dictionary, so that an unknown one is refused as any bad input is.
macro_rules! asks {
    ($head:literal) => {
        concat!(
            $head,
            ", radius=None, exponent=None, inversion=None, looks=None, scores=False, thickness=None, within=None, ",
            "threads=None)\n--\n"
        )
    };
}
