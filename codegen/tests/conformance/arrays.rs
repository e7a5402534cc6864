//! Programs that call generated MATLAB and JAX and print a number a line, as those of `drivers` do.

use std::fmt::Write;

use crate::case::{COMPARED, Case, FORMS, SINGLE};
use crate::drivers::numpy;

pub fn matlab(cases: &[Case]) -> String {
    let mut text = String::from(
        "1;
function show(out, rows, is_single)
  names = fieldnames(out);
  for row = rows
    for n = 1:numel(names)
      values = out.(names{n});
      if is_single
        page = values.';
      elseif ndims(values) == 3
        page = values(:, :, row).';
      else
        page = values(:, row);
      end
      printf('%.17g\\n', page(:));
    end
  end
end
function out = at(columns, row)
  names = fieldnames(columns);
  for n = 1:numel(names)
    out.(names{n}) = columns.(names{n})(row);
  end
end
",
    );
    for case in cases {
        let name = case.name;
        writeln!(text, "of = {name}();\nerrors = struct();").unwrap();
        for (at, &id) in case.errors().iter().enumerate() {
            let value = case.column(id)[0].clone();
            writeln!(text, "fields = fieldnames(of.no_errors); errors.(fields{{{}}}) = {value};", at + 1)
                .unwrap();
        }
        for (argument, symbols) in &case.pose {
            writeln!(text, "{argument} = struct();").unwrap();
            for &id in symbols {
                let (field, column) = (case.symbol_name(id), case.column(id).join("; "));
                writeln!(text, "{argument}.{field} = [{column}];").unwrap();
            }
        }
        let one_pose = case.of_pose(&|argument, _| format!("at({argument}, row)"));
        let many_poses = case.of_pose(&|argument, _| argument.to_owned());
        let compared = COMPARED.map(|row| (row + 1).to_string()).join(", ");
        for (_, form_name) in FORMS {
            write!(
                text,
                "p = of.prepare_{form_name}(errors);
for row = 1:{SINGLE}
  show(of.{form_name}(p, {one_pose}), 1, true);
end
show(of.{form_name}(p, {many_poses}), [{compared}], false);
"
            )
            .unwrap();
        }
    }
    text
}

pub fn jax(cases: &[Case]) -> String {
    // The functions of both take the same arguments; named tuples have fields as data classes do.
    let double = "import jax\n\njax.config.update('jax_enable_x64', True)\n";
    let fields = "[getattr(out, field.name) for field in dataclasses.fields(out)]";
    let text = numpy(cases).replace(fields, "[np.asarray(array) for array in out]");
    format!("{double}{text}")
}
