//! Many passports, in the order of their programs, styles and versions.

use super::difference::{Difference, difference};
use super::version::version_order;
use crate::study::Verdict;
use crate::study::convention::{PassportFile, UnreadablePassport, permanent_name, plain};
use std::collections::BTreeMap;

/// A passport with the name of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedPassport {
    /// Its permanent name.
    pub name: String,
    /// Its JSON.
    pub text: Vec<u8>,
    /// The passport that this JSON holds.
    pub passport: PassportFile,
}

/// Passports in the order of program, style, version and date.
#[derive(Debug, Clone, PartialEq)]
pub struct Atlas {
    /// The latest passport of each version of each style.
    pub passports: Vec<NamedPassport>,
    /// Passports that later ones of the same version have replaced.
    pub replaced: Vec<NamedPassport>,
}

/// A change from one version of a style to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge<'a> {
    /// The older version.
    pub before: &'a NamedPassport,
    /// The newer one.
    pub after: &'a NamedPassport,
    /// What changed.
    pub difference: Difference,
}

impl NamedPassport {
    /// Reads the passport in this JSON `text`.
    ///
    /// # Errors
    /// If it is no passport.
    pub fn read(text: Vec<u8>) -> Result<Self, UnreadablePassport> {
        let passport = PassportFile::read(&text)?;
        let name = permanent_name(&passport, &text);
        Ok(Self {
            name,
            text,
            passport,
        })
    }

    /// Returns program and style as they stand in names, which all versions share.
    fn lineage(&self) -> [String; 2] {
        [&self.passport.software, &self.passport.style].map(|part| plain(part))
    }

    /// Returns the key by which passports are sorted: program and style, then version.
    fn place(&self) -> ([String; 2], Vec<i64>, String) {
        let version = &self.passport.program.version;
        (self.lineage(), version_order(version), version.clone())
    }

    /// Returns the properties that differ from what was declared or asked for.
    pub fn differing(&self) -> impl Iterator<Item = &str> {
        let properties = self.passport.properties.iter();
        let off = properties.filter(|own| own.verdict == Verdict::Differs);
        off.map(|own| own.property.as_str())
    }
}

impl Atlas {
    /// Sorts `passports` into an atlas.
    pub fn new(mut passports: Vec<NamedPassport>) -> Self {
        passports.sort_by(|one, other| one.passport.date.cmp(&other.passport.date));
        let mut latest = BTreeMap::new();
        let replaced = passports
            .into_iter()
            .filter_map(|own| latest.insert(own.place(), own))
            .collect();
        Self {
            passports: latest.into_values().collect(),
            replaced,
        }
    }

    /// Returns the passports of each style of each program, oldest version first.
    pub fn lineages(&self) -> impl Iterator<Item = &[NamedPassport]> {
        self.passports
            .chunk_by(|one, next| one.lineage() == next.lineage())
    }

    /// Returns every change from one version of a style to the next.
    pub fn edges(&self) -> Vec<Edge<'_>> {
        let steps = self.lineages().flat_map(|versions| versions.windows(2));
        let edges = steps.map(|step| Edge {
            before: &step[0],
            after: &step[1],
            difference: difference(&step[0].passport, &step[1].passport),
        });
        edges.filter(|edge| !edge.difference.is_none()).collect()
    }

    /// Returns the names of all properties, in the order of the passports.
    pub fn properties(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for row in self
            .passports
            .iter()
            .flat_map(|own| &own.passport.properties)
        {
            if !names.contains(&row.property.as_str()) {
                names.push(&row.property);
            }
        }
        names
    }
}
