//! A trend as a table.

use trueness_document::trend::{Control, TrendDocument};
use trueness_files::write::{Csv, LineEnd};

/// One line a characteristic; numbers with all digits (RFC 4180).
pub fn csv(document: &TrendDocument) -> Vec<u8> {
    let head = "id,kind,feature,datums,unit,lower,upper,parts,measured,mean,std_dev,std_dev_within,min,max,\
                control_lower,control_upper,cp,cp_low,cp_high,cpk,cpk_low,cpk_high,pp,pp_low,pp_high,ppk,ppk_low,ppk_high,\
                out_of_control";
    let mut out = vec![];
    let mut csv = Csv::at_end_of(&mut out, LineEnd::CrLf);
    csv.row(head.split(','));
    for c in &document.characteristics {
        csv.text(&c.id).text(&c.kind).text(&c.feature).text(&c.datums.join(" ")).text(&c.unit);
        csv.optional(c.lower).optional(c.upper).number(c.values.len()).number(c.measured);
        let control = |f: fn(&Control) -> f64| c.control.as_ref().map(f);
        let numbers =
            [c.mean, c.std_dev, c.std_dev_within, c.min, c.max, control(|x| x.lower), control(|x| x.upper)];
        for number in numbers {
            csv.optional(number);
        }
        for index in [c.cp, c.cpk, c.pp, c.ppk] {
            csv.optional(index.map(|i| i.value));
            csv.optional(index.map(|i| i.low)).optional(index.map(|i| i.high));
        }
        let parts: Vec<String> = c.signaled().iter().map(|n| (n + 1).to_string()).collect();
        csv.text(&parts.join(" ")).end_row();
    }
    out
}
