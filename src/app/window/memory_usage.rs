//! Resident memory of the program.

/// Megabytes of the program's memory that are in the machine's; `None` where the system does not say.
pub(crate) fn resident() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024e-6)
}

#[cfg(test)]
mod tests {
    #[test]
    #[cfg(target_os = "linux")]
    fn the_program_holds_some_memory() {
        let megabytes = super::resident().expect("Linux says");
        assert!(megabytes > 1.0 && megabytes < 1e6, "{megabytes}");
    }
}
