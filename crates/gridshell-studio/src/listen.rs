//! Takes connections and has each answered. Requests whose head does not come to its end are dropped, which
//! `axum::serve` does not do.

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};

/// The head of a request has to be here after so long, and idle connections are closed: a browser opens new ones.
/// Sockets of tabs are not meant.
const HEAD_PATIENCE: Duration = Duration::from_secs(15);
/// Where no connection can be taken (too many files are open, say), after so long it is tried again.
const PAUSE: Duration = Duration::from_millis(500);

/// Answer until the process ends.
pub async fn serve(listener: TcpListener, router: Router) {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => drop(tokio::spawn(connection(stream, router.clone()))),
            Err(_) => tokio::time::sleep(PAUSE).await,
        }
    }
}

async fn connection(stream: TcpStream, router: Router) {
    // Small messages at once; what refuses that is as good.
    let _ = stream.set_nodelay(true);
    let service = TowerToHyperService::new(router);
    let answered = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD_PATIENCE)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    // Who breaks off need not be told of it.
    let _ = answered.await;
}
