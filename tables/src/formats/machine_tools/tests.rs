//! What the reader of tests of machine tools computes, against numbers that were worked out by hand.

use crate::formats::{Cells, Form, Options, TableReader, Wanted, open};

fn opened(text: &str) -> Result<Box<dyn TableReader + '_>, String> {
    open(text.as_bytes(), "test.csv", &Options::default()).map_err(|error| error.to_string())
}

/// The numbers of a column as they stand.
fn column(text: &str, name: &str) -> Result<Vec<f64>, String> {
    let mut reader = opened(text)?;
    let at = reader.header().iter().position(|column| column.full == name);
    let at = at.ok_or_else(|| format!("no column {name}: {}", reader.remarks().join(" ")))?;
    let wanted = [Wanted { column: at, form: Form::Number(1.0) }];
    match reader.read(&wanted, usize::MAX).map_err(|error| error.to_string())?.columns.pop() {
        Some(Cells::Numbers(numbers)) => Ok(numbers),
        other => Err(format!("{other:?}")),
    }
}

#[test]
fn deviations_become_positions_with_the_digits_of_both() {
    let grid = "x [mm],y [mm],z [mm],dx [um],dy [um],dz [um]\n100.1,0.3,-5,1.7,-0.2,0\n0,0,0,1,2,3\n";
    assert_eq!(column(grid, "true_x [mm]"), Ok(vec![100.1017, 0.001]));
    assert_eq!(column(grid, "true_y [mm]"), Ok(vec![0.2998, 0.002]));
    let opposite = format!("# deviation = commanded - actual\n{grid}");
    assert_eq!(column(&opposite, "true_x [mm]"), Ok(vec![100.0983, -0.001]));
    let plate = grid.replace("x [mm],y", "ball x [mm],y");
    assert_eq!(column(&plate, "machine_x [mm]"), Ok(vec![100.1017, 0.001]));
    let plate = format!("# deviation = calibrated - machine\n{plate}");
    assert_eq!(column(&plate, "machine_x [mm]"), Ok(vec![100.0983, -0.001]));
}

#[test]
fn an_angle_and_a_radius_become_positions_and_a_length() {
    let bar = "# plane = YZ\nangle [deg];r [mm];dr [um]\n0;100;-1,5\n90;100;2\n";
    assert_eq!(column(bar, "bar_length [mm]"), Ok(vec![99.9985, 100.002]));
    assert_eq!(column(bar, "commanded_y [mm]").map(|own| own[0]), Ok(100.0));
    assert_eq!(column(bar, "commanded_z [mm]").map(|own| own[1]), Ok(100.0));
    // What was read before is read again.
    let again = "x [mm],y [mm],dr [um],bar_length [mm]\n3,4,1,5.1\n";
    assert_eq!(column(again, "bar_length [mm]"), Ok(vec![5.1]));
    assert_eq!(opened(again).map(|reader| reader.header().len()), Ok(4));
}

#[test]
fn displacements_of_a_table_are_turned_to_the_axes_of_the_machine() {
    let table =
        "# displacement = table\nx [mm],y [mm],z [mm],c [deg],dx [um],dy [um],dz [um]\n10,0,0,90,1,0,5\n";
    // A table at +90° has turned by -90°: its x is the machine's -y.
    let near = |name: &str, expected: f64| {
        let found = column(table, name).map(|own| own[0]);
        assert!(found.as_ref().is_ok_and(|own| (own - expected).abs() < 1e-12), "{name}: {found:?}");
    };
    near("true_x [mm]", 10.0);
    near("true_y [mm]", -0.001);
    near("true_z [mm]", 0.005);
    let machine = table.replace("= table", "= machine");
    assert_eq!(column(&machine, "true_x [mm]"), Ok(vec![10.001]));
    let opposite = format!("# deviation = table - tool\n{machine}");
    assert_eq!(column(&opposite, "true_x [mm]"), Ok(vec![9.999]));
}

#[test]
fn cells_that_are_no_numbers_have_their_place() {
    let grid = "x [mm],y [mm],z [mm],dx [um],dy [um],dz [um]\n1,2,3,4,5,6\n1,2,3,,5,6\n";
    let why = column(grid, "true_x [mm]").err().unwrap_or_default();
    assert!(why.contains("line 3, row 2, column `dx [um]`"), "{why}");
    let large = "x [mm],y [mm],z [mm],dx [um],dy [um],dz [um]\n1e308,2,3,1e308,5,6\n";
    assert!(column(&large.replace("mm", "km"), "true_x [km]").is_err());
}

#[test]
fn other_tables_are_read_as_they_are() {
    for header in ["x,y,z", "alpha,beta,gamma,x,y,z", "x,y,z,tip_x,tip_y,tip_z", "dx,dy,dz", "deviation,star"]
    {
        let text = format!("{header}\n");
        let reader = opened(&text);
        let found = reader.map(|reader| (reader.header().len(), reader.remarks()));
        assert_eq!(found, Ok((header.split(',').count(), Vec::new())), "{header}");
    }
}
