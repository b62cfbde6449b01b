use super::*;

#[test]
fn a_job_past_its_time_gives_up_only_after_its_patience() {
    let job = Job::default().with_time_limit(Duration::ZERO).with_patience(Duration::from_secs(60));
    assert!(job.stopped() && job.check("reading").is_ok());
    let job = Job::default().with_patience(Duration::ZERO);
    assert!(!job.stopped() && job.check("reading").is_ok());
    job.cancel();
    let said = job.check("reading").expect_err("it is over").to_string();
    assert!(said.contains("stopped reading, before there was a grid"), "{said}");
    assert!(job.finishing().check("writing").is_ok() && !job.finishing().stopped());
}

#[test]
fn work_that_never_polls_is_left_behind() {
    let job = Job::default().with_patience(Duration::ZERO);
    let (free, waits) = std::sync::mpsc::channel::<()>();
    let cancelled = job.clone();
    let work = move || {
        cancelled.cancel();
        waits.recv()
    };
    assert!(matches!(job.apart("reading", work), Err(Error::Stopped { .. })));
    drop(free);
    let job = Job::default();
    assert_eq!(job.apart("reading", || 7).unwrap(), 7);
    let broken = std::panic::catch_unwind(|| {
        Job::default().apart("reading", || panic!("a decoder's fault"))
    });
    assert!(broken.is_err());
}

#[test]
fn a_process_over_its_memory_limit_is_told_the_limit() {
    let job = Job::default().with_memory_limit(1 << 20);
    let said = job.check("sewing").expect_err("the tests hold more than this").to_string();
    assert!(said.contains("memory limit of 1.0 MiB"), "{said}");
    let job = Job::default().with_memory_limit(1 << 44);
    assert!(job.check("sewing").is_ok());
    assert!(matches!(job.reserve(1e14, "a grid"), Err(Error::Memory(_))));
    assert!(job.reserve(1e3, "a grid").is_ok() && Job::default().reserve(1e30, "a grid").is_ok());
}

#[test]
fn amounts_of_memory_are_read_as_people_write_them() {
    for (text, bytes) in [
        ("500M", 500 << 20),
        ("2g", 2 << 30),
        ("1.5GiB", 3 << 29),
        ("4096", 4096),
        ("64 KB", 64 << 10),
    ] {
        assert_eq!(memory::parse(text).expect(text), bytes);
    }
    for text in ["", "G", "ib", "-1G", "0", "nan", "inf", "1e400", "2 gallons", "1 2G"] {
        assert!(memory::parse(text).is_err(), "{text}");
    }
    assert_eq!(memory::told(3 << 29), "1.5 GiB");
}

#[test]
fn a_counting_job_stops_at_its_poll() {
    let job = Job::counting(3, 2);
    assert_eq!([(); 4].map(|()| job.stopped()), [false, false, true, true]);
    assert!(job.check("sewing").is_err(), "poll 5 of 3 + 2");
    assert_eq!(job.polls().into_iter().collect::<Vec<_>>(), [("", 4), ("sewing", 1)]);
}
