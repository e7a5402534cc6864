//! The page of the book on the catalogue is written by the catalogue itself.
//!
//! `UPDATE_CATALOGUE=1 cargo test -p trueaxis-calibration --test catalogue page` writes it anew.

use std::fmt::Write as _;
use std::path::PathBuf;

use effects::candidate::Effect;
use effects::catalogue::{known_names, published};
use effects::families::FAMILIES;

use crate::pattern;
use crate::support::{Asked, example, mounts, root};

/// Families with a picture: the effect that is drawn, of the alt-azimuth mount, and which of its functions.
const PICTURES: &[(&str, &str, usize)] = &[
    ("assembly", "constant rotation of fork axis about x", 0),
    ("encoder", "encoder ellipticity of azimuth", 0),
    ("gravity", "gravity flexure of tube about x", 1),
    ("joint motion", "tilt of the azimuth axis, 3 per turn forward", 0),
    ("refraction", "refraction, cot of elevation", 0),
    ("mirror tilt", "beam not along the elevation axis before its mirror", 0),
    ("coupling", "coupling of azimuth into tube about z, harmonic 2", 0),
    ("products", "azimuth and elevation together in fork about z", 0),
    ("thermal", "temperature in fork about z", 0),
];

fn folder() -> PathBuf {
    root().join("docs/src/diagnosis")
}

fn alt_azimuth() -> Asked {
    let chain = example("alt-azimuth/alt-azimuth.chain");
    Asked::of(
        &chain,
        "sight",
        "direction",
        "[columns]\ntemperature = { column = \"t\", meaning = \"temperature\" }\n[search]\ninputs = [\"temperature\"]\n",
    )
}

/// The text on one line.
fn told(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `TPOINT IA`, each with the meaning that its field gives it, for the members of a family; generic harmonics as one.
fn names_of(family: &str) -> Vec<String> {
    let meanings = published();
    let mut names: Vec<String> = Vec::new();
    for asked in mounts() {
        let effects = asked.catalogue();
        let known = known_names(&asked.setting(), &effects);
        for name in
            effects.iter().zip(known).filter(|(effect, _)| effect.family == family).flat_map(|(_, n)| n)
        {
            let own = meanings.iter().find(|known| (known.field, &known.name) == (name.field, &name.name));
            let meaning = own.map_or("", |known| known.meaning);
            // HASA2 to HASA8 are one entry.
            let stem = name.to_string();
            let stem = if meaning.starts_with("harmonic") {
                format!("{}…", stem.trim_end_matches(|c: char| c.is_ascii_digit()))
            } else {
                stem
            };
            let entry = format!("{stem} ({meaning})");
            if !names.contains(&entry) {
                names.push(entry);
            }
        }
    }
    names
}

/// Fields in the order in which their names are told.
fn by_field(mut names: Vec<String>) -> String {
    names.sort_by_key(|name| name.split(' ').next().map(str::to_owned));
    names.join(", ")
}

/// A study that chooses from the catalogue; the book's test runs it.
const EXAMPLE: &str = "\
This study looks for effects of two families only:

<!-- file: few.toml -->
```toml
chain = \"examples/course/mount.chain\"
data  = \"examples/course/secret.csv\"

[columns]
azimuth   = { column = \"azimuth [deg]\", unit = \"deg\" }
elevation = { column = \"elevation [deg]\", unit = \"deg\" }

[observed]
kind = \"direction\"
x = \"east\"
y = \"north\"
z = \"up\"

[search]
effects = [\"encoder\", \"gravity\"]
```

```sh
trueaxis calibrate few.toml --out few
```

```text
EFFECT FOUND, 3 POSSIBLE CAUSES
…
```
";

fn page() -> String {
    let mut told_before: Vec<String> = Vec::new();
    let mut page = String::from(
        "# The catalogue of effects\n\n\
         <!-- Written by the catalogue: UPDATE_CATALOGUE=1 cargo test -p trueaxis-calibration --test catalogue page -->\n\n\
         What a declaration may lack. Every effect follows from the chain: a place, a degree of freedom, and functions of \
         joints and inputs, each multiplied by a new error. A study chooses from the catalogue with \
         `effects = [\"encoder\", \"TF\"]` in its `[search]`: by the name of an effect or of its family, with `*` for any \
         letters, or by a name of another field. Such a name belongs to every effect whose first-order column is the \
         formula that the field published, up to a factor; the algebra decides. It is listed here with the first family \
         that has such an effect, and a report gives it beside every one. Signs follow each field's conventions and \
         are no part of a name.\n\n\
         Pictures show an effect of the family on an alt-azimuth mount: where the line of sight goes from each dot, over the sky, the \
         horizon as the rim, north up and east to the right.\n\n",
    );
    page.push_str(EXAMPLE);
    for family in FAMILIES {
        let mut name = family.name.to_owned();
        name[..1].make_ascii_uppercase();
        let _ = write!(page, "\n## {name}\n\n{}\n\n", told(family.what));
        if let Some((_, effect, _)) = PICTURES.iter().find(|(known, ..)| *known == family.name) {
            let _ = write!(page, "![{effect}](catalogue/{}.svg)\n\n*{effect}*\n\n", file(family.name));
        }
        let _ = writeln!(page, "- **Causes.** {}", told(family.causes));
        let _ = writeln!(page, "- **Looks like.** {}", told(family.looks));
        let _ = writeln!(page, "- **Check.** {}", told(family.check));
        let mut names = names_of(family.name);
        names.retain(|name| !told_before.contains(name));
        told_before.extend(names.clone());
        if !names.is_empty() {
            let _ = writeln!(page, "- **Names in other fields.** {}.", by_field(names));
        }
    }
    page
}

fn file(family: &str) -> String {
    family.replace(' ', "-")
}

/// Every file of the page, with its path below `docs/src/diagnosis`.
fn files() -> Vec<(String, String)> {
    let asked = alt_azimuth();
    let effects = asked.catalogue();
    let picture = |&(family, name, function): &(&str, &str, usize)| {
        let alike: Vec<&Effect> = effects
            .iter()
            .filter(|effect| effect.name == name && function < effect.functions.len())
            .collect();
        let effect = alike.last().unwrap_or_else(|| panic!("no effect is called {name}"));
        assert_eq!(effect.family, family);
        let svg = pattern::sky(effect, function, &asked.plan.chain, "sight");
        (format!("catalogue/{}.svg", file(family)), svg)
    };
    std::iter::once(("catalogue.md".to_owned(), page())).chain(PICTURES.iter().map(picture)).collect()
}

#[test]
fn the_page_says_what_the_catalogue_has() {
    for (path, text) in files() {
        let path = folder().join(path);
        if std::env::var_os("UPDATE_CATALOGUE").is_some() {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, &text).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            kept == text,
            "{} is stale: UPDATE_CATALOGUE=1 cargo test -p trueaxis-calibration --test catalogue page",
            path.display()
        );
    }
}

#[test]
fn every_family_is_explained() {
    for family in FAMILIES {
        for text in [family.what, family.causes, family.looks, family.check] {
            assert!(text.ends_with('.'), "{}: {text}", family.name);
        }
    }
}
