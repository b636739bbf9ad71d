//! The guide, as it is in `assets/guide`; only in the documentation. Links between pages are those of the repository.

#[doc = include_str!("../assets/guide/using.md")]
pub mod using {}
#[doc = include_str!("../assets/guide/explorer.md")]
pub mod explorer {}
#[doc = include_str!("../assets/guide/lessons.md")]
pub mod lessons {}
#[doc = include_str!("../assets/guide/scenes.md")]
pub mod scenes {}
#[doc = include_str!("../assets/guide/sweeps.md")]
pub mod sweeps {}
#[doc = include_str!("../assets/guide/recording.md")]
pub mod recording {}
#[doc = include_str!("../assets/guide/files.md")]
pub mod files {}
#[doc = include_str!("../assets/guide/numerics.md")]
pub mod numerics {}
#[doc = include_str!("../assets/guide/life.md")]
pub mod life {}
#[doc = include_str!("../assets/guide/trust.md")]
pub mod trust {}
#[doc = include_str!("../assets/guide/glossary.md")]
pub mod glossary {}
#[doc = include_str!("../assets/guide/contributing.md")]
pub mod contributing {}
#[doc = include_str!("../assets/guide/changes.md")]
pub mod changes {}
