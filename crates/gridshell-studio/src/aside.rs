//! Work beside the run: on threads of its own, as those that the run shares may all be busy for minutes.

use rayon::ThreadPoolBuilder;

/// Do `work`, whose parallel parts run on threads made for it: a tenth of a millisecond each, and none that another's
/// work could hold up. The result is the same on any threads.
pub fn aside<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match ThreadPoolBuilder::new().build() {
        Ok(threads) => threads.install(work),
        // Where the system gives no more threads it waits for the run's.
        Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use super::aside;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    #[test]
    fn work_goes_on_while_all_shared_threads_are_busy() {
        let all = rayon::current_num_threads();
        let (begun, begins) = channel();
        let mut ends = Vec::new();
        for _ in 0..all {
            let (end, ended) = channel::<()>();
            let begun = begun.clone();
            rayon::spawn(move || {
                let _ = begun.send(());
                let _ = ended.recv();
            });
            ends.push(end);
        }
        for _ in 0..all {
            begins.recv().unwrap();
        }
        let (done, told) = channel();
        std::thread::spawn(move || done.send(aside(|| rayon::join(|| 2, || 3))));
        assert_eq!(told.recv_timeout(Duration::from_secs(20)), Ok((2, 3)));
        drop(ends);
    }
}
