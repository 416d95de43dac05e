//! Texts of IGES for tests, entity by entity.

/// A text that is written.
#[derive(Clone)]
pub(super) struct Text {
    /// Two global parameters: the flag of the unit and its name.
    unit: &'static str,
    entities: Vec<Written>,
}

#[derive(Clone, Default)]
struct Written {
    kind: u64,
    form: i64,
    matrix: u64,
    color: i64,
    status: &'static str,
    label: &'static str,
    parameters: String,
}

impl Text {
    pub fn new() -> Text {
        Text { unit: "2,2HMM", entities: vec![] }
    }

    /// One in another unit.
    pub fn in_unit(unit: &'static str) -> Text {
        Text { unit, ..Text::new() }
    }

    /// Adds an entity; the number by which others name it.
    pub fn add(&mut self, kind: u64, parameters: impl Into<String>) -> u64 {
        self.form(kind, 0, parameters)
    }

    pub fn form(&mut self, kind: u64, form: i64, parameters: impl Into<String>) -> u64 {
        let parameters = parameters.into();
        self.entities.push(Written { kind, form, parameters, status: "00000000", ..Written::default() });
        2 * self.entities.len() as u64 - 1
    }

    fn last(&mut self) -> &mut Written {
        self.entities.last_mut().unwrap()
    }

    /// The matrix of the entity that was added last; so with the others.
    pub fn placed(&mut self, matrix: u64) {
        self.last().matrix = matrix;
    }

    pub fn colored(&mut self, color: i64) {
        self.last().color = color;
    }

    pub fn status(&mut self, status: &'static str) {
        self.last().status = status;
    }

    pub fn labeled(&mut self, label: &'static str) {
        self.last().label = label;
    }

    pub fn bytes(&self) -> Vec<u8> {
        let mut out = format!("{:<72}S{:>7}\n", "test", 1);
        let global = format!(
            "1H,,1H;,4Htest,8Htest.igs,1H,,1H;,32,38,6,308,15,4Htest,1.,{},1,.01,4Hdate,1.E-6,9.,,,11,0;",
            self.unit
        );
        for (k, line) in cut(&global, 72).iter().enumerate() {
            out += &format!("{line:<72}G{:>7}\n", k + 1);
        }
        let (mut parameters, mut row) = (String::new(), 1);
        for (n, e) in self.entities.iter().enumerate() {
            let lines = cut(&format!("{},{};", e.kind, e.parameters), 64);
            let de = 2 * n + 1;
            let (kind, matrix, status, color, form) = (e.kind, e.matrix, e.status, e.color, e.form);
            out += &format!(
                "{kind:>8}{row:>8}{0:>8}{0:>8}{0:>8}{0:>8}{matrix:>8}{0:>8}{status:>8}D{de:>7}\n",
                0
            );
            out += &format!(
                "{kind:>8}{:>8}{color:>8}{:>8}{form:>8}{:>16}{:>8}{:>8}D{:>7}\n",
                0,
                lines.len(),
                "",
                e.label,
                0,
                de + 1
            );
            for line in lines {
                parameters += &format!("{line:<64}{de:>8}P{row:>7}\n");
                row += 1;
            }
        }
        out += &parameters;
        out += &format!("{:<72}T{:>7}\n", "S      1G      1", 1);
        out.into_bytes()
    }
}

/// Lines of `width` columns, anywhere cut: others cut numbers too.
fn cut(text: &str, width: usize) -> Vec<String> {
    text.as_bytes().chunks(width).map(|c| String::from_utf8(c.to_vec()).unwrap()).collect()
}

/// Numbers with commas between.
pub(super) fn list<T: ToString>(numbers: impl IntoIterator<Item = T>) -> String {
    numbers.into_iter().map(|n| n.to_string()).collect::<Vec<_>>().join(",")
}
