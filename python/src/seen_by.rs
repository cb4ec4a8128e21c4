//! What many cameras see.

use hidden_point_removal::{Camera, CameraView, Error, Options, Threads};

/// What some cameras see. Each has a thread of its own; a single one is divided among all threads.
pub fn views(
    cloud: Threads<'_>,
    cameras: &[Camera],
    options: &Options,
) -> Result<Vec<CameraView>, Error> {
    if let [camera] = cameras {
        return Ok(vec![cloud.visible_from_camera(camera, options)?]);
    }
    std::thread::scope(|scope| {
        let spawn = |camera| scope.spawn(move || (*cloud).visible_from_camera(camera, options));
        let asked: Vec<_> = cameras.iter().map(spawn).collect();
        let answer = |thread: std::thread::ScopedJoinHandle<'_, _>| {
            thread
                .join()
                .unwrap_or_else(|fault| std::panic::resume_unwind(fault))
        };
        asked.into_iter().map(answer).collect()
    })
}
