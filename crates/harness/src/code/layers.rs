//! The manifests behind a folder: its own, and those that it extends, merged key by key. Every key and value keeps its
//! place, so that an error names file and line.

use super::folder::{Folder, MANIFEST};
use super::manifest_error::{ManifestError, Place, explained, refused};
use crate::model::InvalidValue;
use serde::Deserialize;
use std::io::ErrorKind;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The version of the keys.
const SCHEMA: &str = "1";
/// Most manifests in a chain of extensions; a longer chain is taken for a circle.
const MOST_LAYERS: usize = 8;
/// Keys that are not inherited: they say what a code is called, or concern one manifest alone.
const OWN_KEYS: [&str; 9] = [
    "schema", "name", "title", "label", "style", "install", "mark", "extends", "variants",
];

/// One manifest.
struct Layer {
    folder: Folder,
    /// The code of its folder whose keys are inherited, if one is named.
    variant: Option<String>,
    /// Its text after as many blanks as all texts before it are long, so that no two texts share a place.
    text: String,
    start: usize,
}

/// The manifests behind a folder, its own first.
pub(super) struct Layers(Vec<Layer>);

impl Layers {
    /// Reads the manifest of `folder` and those that it extends.
    pub fn read(folder: Folder) -> Result<Self, ManifestError> {
        let mut layers = Self(Vec::new());
        layers.add(folder, None)?;
        while let Some((value, folder, variant)) = layers.next_base()? {
            let extends = |problem: &str| {
                let message = format!("`extends` is {}: {problem}", value.get_ref());
                ManifestError::new(layers.place(&value.span()), &message)
            };
            if layers.0.len() == MOST_LAYERS {
                return Err(extends("these manifests extend one another in a circle"));
            }
            if let Err(error) = folder.read(MANIFEST) {
                return Err(extends(&format!("cannot read its {MANIFEST}: {error}")));
            }
            layers.add(folder, variant)?;
        }
        Ok(layers)
    }

    fn add(&mut self, folder: Folder, variant: Option<String>) -> Result<(), ManifestError> {
        let failed = |message: String| ManifestError::of_folder(folder.path(), &message);
        let content = folder.read(MANIFEST);
        let content = content.map_err(|error| failed(format!("cannot read it: {error}")))?;
        let text = String::from_utf8(content).map_err(|error| failed(error.to_string()))?;
        let start = self.0.last().map_or(0, |last| last.text.len() + 1);
        let text = " ".repeat(start) + &text;
        self.0.push(Layer {
            folder,
            variant,
            text,
            start,
        });
        self.check_schema()
    }

    /// Refuses the last manifest if its keys have another version or none.
    fn check_schema(&self) -> Result<(), ManifestError> {
        let table = self.table(self.0.len() - 1)?;
        match table.get("schema").map(Spanned::get_ref) {
            Some(DeValue::Integer(found)) if found.as_str() == SCHEMA => Ok(()),
            Some(DeValue::Integer(found)) => {
                let invalid = refused("schema", found.as_str(), SCHEMA);
                Err(self.invalid(&table, &invalid))
            }
            _ => {
                let message = format!("`schema` is missing; accepted is schema = {SCHEMA}");
                Err(ManifestError::of_folder(
                    self.last().folder.path(),
                    &message,
                ))
            }
        }
    }

    fn last(&self) -> &Layer {
        &self.0[self.0.len() - 1]
    }

    /// Returns the value of `extends` in the last manifest, with the folder that it names and the code there.
    #[allow(clippy::type_complexity)] // It has one use.
    fn next_base(
        &self,
    ) -> Result<Option<(Spanned<String>, Folder, Option<String>)>, ManifestError> {
        let table = self.table(self.0.len() - 1)?;
        let Some(value) = table.get("extends") else {
            return Ok(None);
        };
        let text = value.get_ref().as_str();
        let found = text.and_then(|text| {
            if !text.contains('/') {
                return Some((Folder::of_built_in(text)?, Some(text.to_owned())));
            }
            let (path, variant) = match text.rsplit_once(':') {
                Some((path, variant)) if !variant.contains('/') => (path, Some(variant)),
                _ => (text, None),
            };
            Some((self.last().folder.at(path)?, variant.map(str::to_owned)))
        });
        let accepted = || {
            format!(
                "the name of a code that comes with tristack ({}) or the path of a folder with a `/`, such as ../other",
                Folder::built_in_names().join(", ")
            )
        };
        let value = Spanned::new(value.span(), text.unwrap_or("no text").to_owned());
        match found {
            Some((folder, variant)) => Ok(Some((value, folder, variant))),
            None => {
                let invalid = refused("extends", value.get_ref(), accepted());
                Err(self.invalid(&table, &invalid))
            }
        }
    }

    /// Parses the keys of a manifest.
    fn table(&self, layer: usize) -> Result<DeTable<'_>, ManifestError> {
        let parsed = DeTable::parse(&self.0[layer].text);
        let parsed = parsed.map_err(|error| {
            let place = error.span().map(|span| self.place(&span));
            ManifestError::new(place.unwrap_or_default(), error.message())
        });
        Ok(parsed?.into_inner())
    }

    /// Returns the keys of the manifest, with those that it inherits.
    pub fn merged(&self) -> Result<DeTable<'_>, ManifestError> {
        let mut merged = DeTable::new();
        for layer in (1..self.0.len()).rev() {
            merge(&mut merged, self.inherited(layer)?);
        }
        merge(&mut merged, self.table(0)?);
        Ok(merged)
    }

    /// Returns the keys that others inherit from a manifest: those of the code that was named or, without a name,
    /// those of the only code or of the one named like the manifest.
    fn inherited(&self, layer: usize) -> Result<DeTable<'_>, ManifestError> {
        let mut table = self.table(layer)?;
        let own = table.get("name").and_then(|name| name.get_ref().as_str());
        let asked = self.0[layer].variant.as_deref().or(own).unwrap_or_default();
        let asked = asked.to_owned();
        let mut variants = variants(&mut table);
        let is_only = variants.is_empty() && own_name(&table) == Some(&asked);
        let chosen = variants.remove(asked.as_str());
        if chosen.is_none() && !is_only {
            let names: Vec<&str> = variants
                .keys()
                .map(|name| name.get_ref().as_ref())
                .collect();
            let names = match names.as_slice() {
                [] => own_name(&table).unwrap_or_default().to_owned(),
                names => format!("one of {}", names.join(", ")),
            };
            let path = self.0[layer].folder.path();
            let message = format!("`{asked}` is extended; accepted after the `:` is {names}");
            return Err(ManifestError::of_folder(path, &message));
        }
        if let Some(DeValue::Table(chosen)) = chosen.map(Spanned::into_inner) {
            merge(&mut table, chosen);
        }
        OWN_KEYS.iter().for_each(|key| _ = table.remove(*key));
        Ok(table)
    }

    /// Returns one set of keys per variant, whose keys override those of `merged`; `merged` itself if there are no
    /// variants.
    pub fn codes<'i>(&self, merged: DeTable<'i>) -> Vec<DeTable<'i>> {
        let mut common = merged;
        let variants = variants(&mut common);
        if variants.is_empty() {
            return vec![common];
        }
        let codes = variants.into_iter().map(|(name, overrides)| {
            let mut table = common.clone();
            let value = DeValue::String(name.get_ref().clone());
            table.remove("name");
            table.insert(
                Spanned::new(name.span(), "name".into()),
                Spanned::new(name.span(), value),
            );
            if let DeValue::Table(overrides) = overrides.into_inner() {
                merge(&mut table, overrides);
            }
            table
        });
        codes.collect()
    }

    /// Reads `table` as a `T`; errors name the place and the key.
    pub fn read_as<'i, T: Deserialize<'i>>(&self, table: DeTable<'i>) -> Result<T, ManifestError> {
        let root = Spanned::new(0..0, table.clone());
        T::deserialize(toml::Deserializer::from(root)).map_err(|error| {
            let span = error.span().unwrap_or_default();
            let path = path_to(&table, &span).unwrap_or_default();
            let message = explained(error.message(), &path.join("."));
            ManifestError::new(self.place(&span), &message)
        })
    }

    /// Returns the error about an `invalid` value in `table`, with its place.
    pub fn invalid(&self, table: &DeTable, invalid: &InvalidValue) -> ManifestError {
        ManifestError::new(self.place_of(table, &invalid.key), &invalid.to_string())
    }

    /// Returns the place in `table` of the key at a dotted path, or of the last of its parts that is there.
    pub fn place_of(&self, table: &DeTable, path: &str) -> Place {
        let (mut table, mut span) = (Some(table), 0..0);
        for part in path.split('.') {
            let entry = table.and_then(|table| table.get_key_value(part));
            let Some((key, value)) = entry else { break };
            span = key.span();
            table = value.get_ref().as_table();
        }
        self.place(&span)
    }

    /// Returns the file and the line of a place in the texts; an empty span at their beginning has no line.
    fn place(&self, span: &Range<usize>) -> Place {
        let layers = self.0.iter().rev();
        let layer = layers.clone().find(|layer| layer.start <= span.start);
        let layer = layer.unwrap_or(&self.0[0]);
        let before = layer.text.get(..span.start).unwrap_or(&layer.text);
        let line = 1 + before.matches('\n').count();
        Place {
            path: layer.folder.path().join(MANIFEST),
            line: (span != &(0..0)).then_some(line),
        }
    }

    /// Returns the folder of the manifest that contains `span`.
    pub fn folder_at(&self, span: &Range<usize>) -> &Folder {
        let mut layers = self.0.iter().rev();
        let layer = layers.find(|layer| layer.start <= span.start);
        &layer.unwrap_or(&self.0[0]).folder
    }

    /// Reads a file from the own folder or, if it is not there, from the first extended folder that has it.
    pub fn file(&self, name: &str) -> std::io::Result<Vec<u8>> {
        let own = self.0[0].folder.read(name);
        let absent = |error: &std::io::Error| error.kind() == ErrorKind::NotFound;
        let others = self.0.iter().skip(1).map(|layer| layer.folder.read(name));
        let mut found = std::iter::once(own).chain(others);
        let mut last = found.find(|content| !content.as_ref().is_err_and(absent));
        last.take().unwrap_or_else(|| self.0[0].folder.read(name))
    }
}

fn own_name<'a>(table: &'a DeTable) -> Option<&'a str> {
    table.get("name")?.get_ref().as_str()
}

/// Takes the variants out of `table`.
fn variants<'i>(table: &mut DeTable<'i>) -> DeTable<'i> {
    match table.remove("variants").map(Spanned::into_inner) {
        Some(DeValue::Table(variants)) => variants,
        _ => DeTable::new(),
    }
}

/// Replaces the values of `table` by those of `overrides`, key by key.
fn merge<'i>(table: &mut DeTable<'i>, overrides: DeTable<'i>) {
    for (key, mut value) in overrides {
        if let Some(mut old) = table.remove(key.get_ref().as_ref())
            && let (DeValue::Table(old), DeValue::Table(own)) = (old.get_mut(), value.get_mut())
        {
            let mut merged = std::mem::take(old);
            merge(&mut merged, std::mem::take(own));
            *own = merged;
        }
        table.insert(key, value);
    }
}

/// Returns the keys that lead to what stands at `span`.
fn path_to(table: &DeTable, span: &Range<usize>) -> Option<Vec<String>> {
    table.iter().find_map(|(key, value)| {
        let name = || key.get_ref().clone().into_owned();
        let own = value.span();
        let deeper = value.get_ref().as_table();
        if let Some(mut path) = deeper.and_then(|table| path_to(table, span)) {
            path.insert(0, name());
            return Some(path);
        }
        let is_here = key.span() == *span || (own.start <= span.start && span.end <= own.end);
        (is_here && span.end > 0).then(|| vec![name()])
    })
}
