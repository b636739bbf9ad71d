//! What the numbers were measured on, as far as it matters for ratios.

use asperity_engine::math::number::counted;

/// Cores and family of the processor, such as `2 cores of family 6 (x86_64)`.
pub fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let cores = counted(cores as u64, "core");
    let family = std::fs::read_to_string("/proc/cpuinfo")
        .ok()
        .and_then(|text| family_of(&text));
    let vectors = vectors();
    match family {
        Some(family) => format!("{cores} of {family} ({vectors})"),
        None => format!("{cores} ({vectors})"),
    }
}

fn family_of(cpuinfo: &str) -> Option<String> {
    let value = |name: &str| {
        let line = cpuinfo.lines().find(|line| {
            let (key, _) = line.split_once(':').unwrap_or((line, ""));
            key.trim() == name
        })?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let (vendor, family) = (value("vendor_id")?, value("cpu family")?);
    Some(match value("model") {
        Some(model) => format!("{vendor} family {family} model {model}"),
        None => format!("{vendor} family {family}"),
    })
}

/// The widest vector units, which decide more about speed here than the clock.
fn vectors() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") {
            return "x86_64 with AVX-512";
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            return "x86_64 with AVX2";
        }
    }
    std::env::consts::ARCH
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_family_is_read() {
        let text = "processor\t: 0\nvendor_id\t: Genuine\ncpu family\t: 6\nmodel\t\t: 85\nmodel name\t: X\n";
        assert_eq!(
            family_of(text).as_deref(),
            Some("Genuine family 6 model 85")
        );
        assert_eq!(family_of("nothing"), None);
        assert!(machine().contains("core"));
    }
}
