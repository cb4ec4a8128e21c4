//! `hpr-mutants FROM TO LIST SKIPPED`: copies `src` from folder to folder and puts mutants into it, each behind a switch.
//!
//! LIST is what `cargo mutants --list --json` prints for FROM. A mutant's number is its place in LIST,
//! from 1. SKIPPED is a file of numbers, one a line: these mutants do not compile, so they are left out. Prints the
//! numbers of the mutants that are in the sources now.
//!
//! One mutant at most is active in a run, so the changed copy of an expression needs no switches inside:
//! `a + b` becomes `(if crate::mutant::is(7) { a - b } else { a + b })`. `src/mutant.rs` answers.

mod edits;
mod places;

use std::collections::HashSet;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use places::{Mutant, put_mutants};

/// What the changed crate asks. Without the environment variable MUTANT no mutant is active. With the value
/// `record`, the file that REACHED names lists each mutant whose place is reached.
const SWITCH: &str = r#"//! Which mutant is active: written by `npm run mutants`.
use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

const RECORD: u32 = u32::MAX;
static ACTIVE: OnceLock<u32> = OnceLock::new();
static REACHED: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

#[inline(always)]
pub fn is(number: u32) -> bool {
    let active = *ACTIVE.get_or_init(|| match std::env::var("MUTANT").as_deref() {
        Ok("record") => RECORD,
        Ok(text) => text.parse().unwrap(),
        Err(_) => 0,
    });
    if active == RECORD && !REACHED[number as usize].load(Ordering::Relaxed) {
        note(number);
    }
    active == number
}

#[cold]
fn note(number: u32) {
    REACHED[number as usize].store(true, Ordering::Relaxed);
    let name = std::env::var("REACHED").unwrap();
    let mut file = std::fs::OpenOptions::new().create(true).append(true).open(name).unwrap();
    file.write_all(std::format!("{number}\n").as_bytes()).unwrap();
}
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = env::args().skip(1).collect();
    let [from, to, list, skipped] = &args[..] else {
        return Err("usage: hpr-mutants FROM TO LIST SKIPPED".into());
    };
    let [from, to] = [from, to].map(Path::new);
    let mutants: Vec<Mutant> = serde_json::from_str(&fs::read_to_string(list)?)?;
    let skipped: HashSet<u32> = fs::read_to_string(skipped)?
        .lines()
        .map(str::parse)
        .collect::<Result<_, _>>()?;
    for file in sources(from, Path::new("src"))? {
        let source = fs::read_to_string(from.join(&file))?;
        let is_here = |(number, mutant): &(u32, &Mutant)| {
            !skipped.contains(number) && Path::new(&mutant.file) == file
        };
        let here: Vec<(u32, &Mutant)> = (1..).zip(&mutants).filter(is_here).collect();
        let (mut changed, numbers) = put_mutants(&source, &here)?;
        for number in numbers {
            println!("{number}");
        }
        if file == Path::new("src/lib.rs") {
            changed = changed
                .replace("\nmod answers;", "\nmod answers;\nmod mutant;")
                // Mutants write `vec![]`.
                .replace("extern crate alloc;", "#[macro_use]\nextern crate alloc;");
        }
        write(&to.join(file), &changed)?;
    }
    let switch = SWITCH.replace("COUNT", &(mutants.len() + 1).to_string());
    write(&to.join("src/mutant.rs"), &switch)
}

/// The Rust files below a folder, named from `root`.
fn sources(root: &Path, folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(root.join(folder))? {
        let entry = entry?;
        let path = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            files.extend(sources(root, &path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

/// Writes a file, unless it has this text already: cargo compiles newer files again.
fn write(path: &Path, text: &str) -> Result<(), Box<dyn Error>> {
    if !fs::read_to_string(path).is_ok_and(|present| present == text) {
        fs::create_dir_all(path.parent().ok_or("a file has a folder")?)?;
        fs::write(path, text)?;
    }
    Ok(())
}
