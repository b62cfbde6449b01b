//! The stages of the method, one file (or folder) each. They never see one another: the pipeline alone
//! knows their order.

pub mod measure;
pub mod pack;
pub mod regularize;
pub mod relax;
pub mod triangulate;
