//! DXF drawings of version AC1015 (2000), ASCII: LINE, ARC, CIRCLE and SPLINE, millimeters, a layer for each contour.
//!
//! Arcs run counter-clockwise in DXF, so one of negative sweep is written from its end. The tables hold what AutoCAD's
//! reference demands: line types, layers, styles, block records; every object has a handle and an owner.

use crate::content::drawing::{Clamped, Entity, Layer, bounds, whole};
use std::io::{self, Write};

/// Writes groups of code and value.
struct Groups<'a> {
    out: &'a mut dyn Write,
    handle: u32,
}

impl Groups<'_> {
    fn put(&mut self, code: u32, value: impl std::fmt::Display) -> io::Result<()> {
        write!(self.out, "{code}\n{value}\n")
    }
    fn all(&mut self, groups: &[(u32, &str)]) -> io::Result<()> {
        groups.iter().try_for_each(|(code, value)| self.put(*code, value))
    }
    fn number(&mut self, code: u32, value: f64) -> io::Result<()> {
        // Shortest digits that read back as the same number; an exponent is allowed, an integer is not.
        self.put(code, format_args!("{value:?}"))
    }
    fn next(&mut self) -> String {
        self.handle += 1;
        format!("{:X}", self.handle)
    }
    fn point(&mut self, code: u32, p: [f64; 2]) -> io::Result<()> {
        self.number(code, p[0])?;
        self.number(code + 10, p[1])?;
        self.number(code + 20, 0.0)
    }
}

/// Handles of the objects that others refer to.
const MODEL_SPACE_HANDLE: &str = "1F";
const PAPER_SPACE_HANDLE: &str = "1B";
const ROOT_DICTIONARY_HANDLE: &str = "C";

/// Writes a drawing.
pub fn write(out: &mut dyn Write, layers: &[Layer]) -> io::Result<()> {
    let mut g = Groups { out, handle: 0xFF };
    header(&mut g, layers)?;
    tables(&mut g, layers)?;
    g.all(&[(0, "SECTION"), (2, "BLOCKS")])?;
    for (name, owner) in [("*Model_Space", MODEL_SPACE_HANDLE), ("*Paper_Space", PAPER_SPACE_HANDLE)] {
        let (begin, end) = (g.next(), g.next());
        g.all(&[(0, "BLOCK"), (5, &begin), (330, owner), (100, "AcDbEntity"), (8, "0")])?;
        g.all(&[(100, "AcDbBlockBegin"), (2, name), (70, "0"), (10, "0.0"), (20, "0.0"), (30, "0.0")])?;
        g.all(&[(3, name), (1, "")])?;
        g.all(&[
            (0, "ENDBLK"),
            (5, &end),
            (330, owner),
            (100, "AcDbEntity"),
            (8, "0"),
            (100, "AcDbBlockEnd"),
        ])?;
    }
    g.all(&[(0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")])?;
    for layer in layers {
        layer.entities.iter().try_for_each(|e| entity(&mut g, &layer.name, e))?;
    }
    g.all(&[(0, "ENDSEC"), (0, "SECTION"), (2, "OBJECTS")])?;
    g.all(&[
        (0, "DICTIONARY"),
        (5, ROOT_DICTIONARY_HANDLE),
        (330, "0"),
        (100, "AcDbDictionary"),
        (281, "1"),
    ])?;
    g.all(&[(3, "ACAD_GROUP"), (350, "D")])?;
    g.all(&[
        (0, "DICTIONARY"),
        (5, "D"),
        (330, ROOT_DICTIONARY_HANDLE),
        (100, "AcDbDictionary"),
        (281, "1"),
    ])?;
    g.all(&[(0, "ENDSEC"), (0, "EOF")])
}

fn header(g: &mut Groups, layers: &[Layer]) -> io::Result<()> {
    let [low, high] = bounds(layers).unwrap_or_default();
    g.all(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"), (9, "$HANDSEED"), (5, "FFFFFF")])?;
    // 4: millimeters; 1: metric.
    g.all(&[(9, "$INSUNITS"), (70, "4"), (9, "$MEASUREMENT"), (70, "1")])?;
    for (name, p) in [("$EXTMIN", low), ("$EXTMAX", high)] {
        g.put(9, name)?;
        g.point(10, p)?;
    }
    g.all(&[(0, "ENDSEC"), (0, "SECTION"), (2, "CLASSES"), (0, "ENDSEC")])
}

fn tables(g: &mut Groups, layers: &[Layer]) -> io::Result<()> {
    g.all(&[(0, "SECTION"), (2, "TABLES")])?;
    table(g, "VPORT", "8", 0)?;
    g.all(&[(0, "ENDTAB")])?;
    table(g, "LTYPE", "5", 3)?;
    for (name, handle) in [("ByBlock", "14"), ("ByLayer", "15"), ("Continuous", "16")] {
        record(g, "LTYPE", handle, "5", "AcDbLinetypeTableRecord", name)?;
        g.all(&[(70, "0"), (3, ""), (72, "65"), (73, "0"), (40, "0.0")])?;
    }
    g.all(&[(0, "ENDTAB")])?;
    table(g, "LAYER", "2", layers.len() + 1)?;
    for (n, name) in std::iter::once("0").chain(layers.iter().map(|l| l.name.as_str())).enumerate() {
        let handle = if n == 0 { "10".into() } else { g.next() };
        record(g, "LAYER", &handle, "2", "AcDbLayerTableRecord", name)?;
        let color = (n % 6 + usize::from(n == 0) * 7).max(1).to_string();
        g.all(&[(70, "0"), (62, &color), (6, "Continuous"), (370, "-3"), (390, "0")])?;
    }
    g.all(&[(0, "ENDTAB")])?;
    table(g, "STYLE", "3", 1)?;
    record(g, "STYLE", "11", "3", "AcDbTextStyleTableRecord", "Standard")?;
    g.all(&[(70, "0"), (40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "2.5"), (3, "txt"), (4, "")])?;
    g.all(&[(0, "ENDTAB")])?;
    for (name, handle) in [("VIEW", "6"), ("UCS", "7")] {
        table(g, name, handle, 0)?;
        g.all(&[(0, "ENDTAB")])?;
    }
    table(g, "APPID", "9", 1)?;
    record(g, "APPID", "12", "9", "AcDbRegAppTableRecord", "ACAD")?;
    g.all(&[(70, "0"), (0, "ENDTAB")])?;
    table(g, "DIMSTYLE", "A", 0)?;
    g.all(&[(100, "AcDbDimStyleTable"), (71, "0"), (0, "ENDTAB")])?;
    table(g, "BLOCK_RECORD", "1", 2)?;
    for (name, handle) in [("*Model_Space", MODEL_SPACE_HANDLE), ("*Paper_Space", PAPER_SPACE_HANDLE)] {
        record(g, "BLOCK_RECORD", handle, "1", "AcDbBlockTableRecord", name)?;
        g.all(&[(340, "0")])?;
    }
    g.all(&[(0, "ENDTAB"), (0, "ENDSEC")])
}

fn table(g: &mut Groups, name: &str, handle: &str, count: usize) -> io::Result<()> {
    let count = count.to_string();
    g.all(&[(0, "TABLE"), (2, name), (5, handle), (330, "0"), (100, "AcDbSymbolTable"), (70, &count)])
}

fn record(g: &mut Groups, kind: &str, handle: &str, owner: &str, class: &str, name: &str) -> io::Result<()> {
    let classes = [(100, "AcDbSymbolTableRecord"), (100, class), (2, name)];
    g.all(&[(0, kind), (5, handle), (330, owner)])?;
    g.all(&classes)
}

fn entity(g: &mut Groups, layer: &str, entity: &Entity) -> io::Result<()> {
    let name = match entity {
        Entity::Line { .. } => "LINE",
        Entity::Arc { sweep, .. } if whole(*sweep) => "CIRCLE",
        Entity::Arc { .. } => "ARC",
        Entity::Spline(_) => "SPLINE",
    };
    let handle = g.next();
    g.all(&[(0, name), (5, &handle), (330, MODEL_SPACE_HANDLE), (100, "AcDbEntity"), (8, layer)])?;
    match entity {
        Entity::Line { start, end } => {
            g.put(100, "AcDbLine")?;
            g.point(10, *start)?;
            g.point(11, *end)
        }
        Entity::Arc { center, radius, start, sweep } => {
            g.put(100, "AcDbCircle")?;
            g.point(10, *center)?;
            g.number(40, *radius)?;
            if whole(*sweep) {
                return Ok(());
            }
            let (from, to) = if *sweep >= 0.0 { (*start, start + sweep) } else { (start + sweep, *start) };
            g.put(100, "AcDbArc")?;
            g.number(50, from.to_degrees().rem_euclid(360.0))?;
            g.number(51, to.to_degrees().rem_euclid(360.0))
        }
        Entity::Spline(Clamped { degree, knots, points }) => {
            g.put(100, "AcDbSpline")?;
            // The normal of its plane; 8: in a plane.
            g.all(&[(210, "0.0"), (220, "0.0"), (230, "1.0"), (70, "8")])?;
            for (code, count) in [(71, *degree), (72, knots.len()), (73, points.len()), (74, 0)] {
                g.put(code, count)?;
            }
            // Knots and control points closer than this are the same: readers round to it. Knots run from 0 to 1.
            g.all(&[(42, "1e-15"), (43, "1e-15")])?;
            knots.iter().try_for_each(|k| g.number(40, *k))?;
            points.iter().try_for_each(|p| g.point(10, *p))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::drawing::tests::one_of_each;

    /// Groups of a drawing, and the numbers of the entities.
    #[test]
    fn entities_are_written_with_their_numbers() {
        let [line, arc, circle, spline] = one_of_each([0.1, 0.2], [1e-20, 3.0]);
        let entities = vec![line, arc, circle, spline];
        let layer = Layer { name: "section-1".into(), entities, ..Layer::default() };
        let mut out = vec![];
        write(&mut out, &[layer]).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let groups: Vec<(u32, &str)> = lines.chunks(2).map(|g| (g[0].parse().unwrap(), g[1])).collect();
        let names: Vec<&str> = groups.iter().filter(|g| g.0 == 0).map(|g| g.1).collect();
        let count = |name: &str| names.iter().filter(|n| **n == name).count();
        assert_eq!((count("LINE"), count("ARC"), count("CIRCLE"), count("SPLINE")), (1, 1, 1, 1));
        assert_eq!((count("SECTION"), count("TABLE")), (count("ENDSEC"), count("ENDTAB")));
        let angle = |code: u32| -> f64 { groups.iter().rfind(|g| g.0 == code).unwrap().1.parse().unwrap() };
        assert!((angle(50) - (-0.5f64).to_degrees().rem_euclid(360.0)).abs() < 1e-12);
        assert!((angle(51) - 0.5f64.to_degrees()).abs() < 1e-12);
        assert!(groups.contains(&(11, "1e-20")) && groups.contains(&(8, "section-1")));
        let mut handles: Vec<&str> = groups.iter().filter(|g| g.0 == 5).map(|g| g.1).collect();
        let all = handles.len();
        handles.sort_unstable();
        handles.dedup();
        assert_eq!(handles.len(), all);
    }
}
