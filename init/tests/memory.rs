//! A declaration and a study out of a table in memory.
#![allow(clippy::unwrap_used, missing_docs)]

use init::{Look, Names, NotBegun, draft, hold, study, templates};
use tables::formats::{Options, open};

fn look(text: &str) -> Result<Look, NotBegun> {
    let mut reader = open(text.as_bytes().to_vec(), "table.csv", &Options::default()).unwrap();
    Look::at(&mut *reader)
}

/// A turntable in steps of ten degrees.
fn table() -> String {
    let row = |step: u32| {
        let angle = f64::from(10 * step).to_radians();
        format!("{},{},{},0\n", 10 * step, angle.cos(), angle.sin())
    };
    "angle [deg],x,y,z\n".to_owned() + &(0..36).map(row).collect::<String>()
}

#[test]
fn a_table_in_memory_becomes_a_declaration_and_a_study_that_read_it() {
    let table = table();
    let look = look(&table).unwrap();
    let (template, draft) = draft(&look, None).unwrap();
    assert_eq!(template.name, "turntable");
    let names = Names {
        chain: "a.chain",
        data: "table.csv",
        command: "trueaxis calibrate a.toml\n[fit]",
        site: None,
        trajectory: None,
    };
    let study = study(&draft, &look, names);
    assert!(study.starts_with("# Begun by trueaxis init: trueaxis calibrate a.toml [fit]\n"), "{study}");
    let doubts = hold(&draft, &study, &mut |name: &str| {
        assert_eq!(name, "table.csv");
        Ok(table.clone().into_bytes().into())
    });
    assert_eq!(doubts.map(|held| held.doubtful), Ok(Vec::new()));
    let short = "angle [deg],x,y\n0,1,0\n".to_owned();
    let refused = hold(&draft, &study, &mut |_: &str| Ok(short.clone().into_bytes().into()));
    assert!(refused.unwrap_err().to_string().contains('z'));
}

#[test]
fn a_table_that_no_template_fits_is_refused() {
    let wrong = look("a,b\n1,2\n").unwrap();
    let refused = draft(&wrong, None).err().unwrap().to_string();
    assert!(refused.starts_with("table.csv: the header does not say which kind of instrument"), "{refused}");
    let refused = draft(&wrong, templates::named("encoder")).err().unwrap().to_string();
    assert!(refused.starts_with("table.csv: an encoder has"), "{refused}");
    assert!(look("1,2\n3,4\n").err().unwrap().to_string().contains("numbers, and no names of columns"));
    assert!(look("a,b\n").is_err());
    assert!(templates::named("toaster").is_none());
}
