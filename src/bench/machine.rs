//! What was measured on.

use crate::dem::LaneWidth;

/// A machine, as far as it matters to what a step costs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Machine {
    /// Its processor, by the name that Linux gives it.
    pub processor: String,
    /// Cores that this process may use.
    pub cores: usize,
    /// Doubles in one of its vectors.
    pub lanes: usize,
}

impl Machine {
    /// This one.
    pub fn this() -> Self {
        let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            processor: model(&processors).unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            lanes: LaneWidth::widest().lanes(),
        }
    }
}

impl std::fmt::Display for Machine {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            processor,
            cores,
            lanes,
        } = self;
        write!(formatter, "{processor}, {cores} cores, {lanes} lanes")
    }
}

/// Name, family, model and stepping: virtual machines often keep the number of the processor to themselves.
fn model(processors: &str) -> Option<String> {
    let field = |name: &str| {
        let mut fields = processors.lines().filter_map(|line| line.split_once(':'));
        let found = fields.find(|(key, _)| key.trim() == name)?;
        Some(found.1.trim().to_owned())
    };
    let name = field("model name")?;
    Some(match (field("cpu family"), field("model")) {
        (Some(family), Some(model)) => format!("{name} (family {family}, model {model})"),
        _ => name,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_processor_has_name_family_and_model() {
        let text = "processor\t: 0\ncpu family\t: 25\nmodel\t\t: 17\nmodel name\t: AMD EPYC\n";
        assert_eq!(model(text).unwrap(), "AMD EPYC (family 25, model 17)");
        assert_eq!(model(""), None);
    }
}
