//! What is wrong with the ICD files that the environment names. The loader passes over what it cannot use
//! without a word.

use std::path::Path;

use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

/// The variables that name drivers, the newer one first; the loader reads the first that is set.
const VARIABLES: [&str; 2] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];

/// A sentence for each file that the loader cannot use.
pub(super) fn faults() -> Vec<String> {
    let set = VARIABLES.into_iter().find_map(|name| Some((name, std::env::var_os(name)?)));
    set.map_or_else(Vec::new, |(name, value)| {
        let files = std::env::split_paths(&value).collect::<Vec<_>>();
        let fault = |file: &std::path::PathBuf| {
            let why = fault(file)?;
            Some(format!("{name} names {}: {}", printable_path(file), printable(&why)))
        };
        files.iter().filter_map(fault).collect()
    })
}

/// What is wrong with a file; of a folder nothing is said.
fn fault(file: &Path) -> Option<String> {
    if file.is_dir() {
        return None;
    }
    match input::read_text(file, limits::NOTE_BYTES) {
        Ok(text) => wrong(&text, file.parent().unwrap_or(Path::new(""))),
        Err(error) => Some(error.cause),
    }
}

/// What is wrong with the text of a file in this folder.
fn wrong(text: &str, folder: &Path) -> Option<String> {
    let json: serde_json::Value = match serde_json::from_str(text) {
        Ok(json) => json,
        Err(error) => return Some(format!("it is not JSON: {error}")),
    };
    let Some(library) = json["ICD"]["library_path"].as_str() else {
        return Some("it has no ICD.library_path".to_owned());
    };
    // A bare name is looked for where the system keeps its libraries.
    let path = folder.join(library);
    let is_missing = library.contains('/') && !path.exists();
    is_missing.then(|| format!("its library {} is not there", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_is_said() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let said = |text: &str| wrong(text, folder).unwrap_or_default();
        assert!(said("{ \"ICD\"").contains("not JSON: EOF"));
        assert!(said("{}").contains("no ICD.library_path"));
        let missing = said(r#"{ "ICD": { "library_path": "./lib-not-there.so" } }"#);
        assert!(missing.contains("lib-not-there.so is not there"), "{missing}");
        assert_eq!(said(r#"{ "ICD": { "library_path": "some.so" } }"#), "");
        assert_eq!(said(r#"{ "ICD": { "library_path": "./Cargo.toml" } }"#), "");
        assert!(fault(&folder.join("no.json")).is_some());
    }
}
