//! Parquet: a table for data tools, written without the Arrow layer, which would double what has to be compiled.

use crate::{
    AtomicFile,
    error::WriteFault,
    format::{
        Format, Head,
        sink::{Block, Layout, PointsSink},
        values::Values,
    },
};
use parquet::{
    basic::{Compression, LogicalType, Repetition, Type as Physical},
    data_type::{DoubleType, Int32Type},
    errors::ParquetError,
    file::{
        properties::WriterProperties,
        writer::{SerializedFileWriter, SerializedRowGroupWriter},
    },
    schema::types::Type,
};
use std::{io, sync::Arc};
use trueness_geom::space::Point;

/// Parquet table.
pub(crate) const PARQUET: Format = Format {
    name: "parquet",
    known_as: &["Parquet"],
    extensions: &[],
    written_as: &["parquet"],
    manual: include_str!("parquet.md"),
    holds: &[],
    columns: false,
    sniff: |_: &Head| false,
    read: None,
    model: None,
    points: Some(begin),
    mesh: None,
};

/// A group holds this many rows at most.
const MAX_ROWS_PER_GROUP: usize = 1 << 20;

fn fault(e: ParquetError) -> WriteFault {
    // The library wraps what the system said.
    let inner = match e {
        ParquetError::External(inner) => inner,
        other => return WriteFault::Io(io::Error::other(other)),
    };
    match inner.downcast::<io::Error>() {
        Ok(e) => WriteFault::Io(*e),
        Err(e) => WriteFault::Io(io::Error::other(e)),
    }
}

fn column(name: &str, kind: Physical, repetition: Repetition) -> Result<Arc<Type>, ParquetError> {
    let builder = Type::primitive_type_builder(name, kind).with_repetition(repetition);
    let byte = LogicalType::integer(8, false);
    let builder = if kind == Physical::INT32 { builder.with_logical_type(Some(byte)) } else { builder };
    Ok(Arc::new(builder.build()?))
}

fn schema(layout: Layout) -> Result<Arc<Type>, ParquetError> {
    let mut columns = vec![];
    for name in ["x", "y", "z"] {
        columns.push(column(name, Physical::DOUBLE, Repetition::REQUIRED)?);
    }
    if layout.deviation {
        columns.push(column("deviation", Physical::DOUBLE, Repetition::OPTIONAL)?);
    }
    if layout.reason {
        columns.push(column("excluded", Physical::INT32, Repetition::REQUIRED)?);
    }
    if layout.color {
        for name in ["red", "green", "blue"] {
            columns.push(column(name, Physical::INT32, Repetition::REQUIRED)?);
        }
    }
    Ok(Arc::new(Type::group_type_builder("points").with_fields(columns).build()?))
}

fn begin(file: AtomicFile, layout: Layout, _: &str) -> Result<Box<dyn PointsSink>, WriteFault> {
    let schema = schema(layout).map_err(fault)?;
    let writer = SerializedFileWriter::new(file, schema, properties()).map_err(fault)?;
    Ok(Box::new(Table { writer, layout }))
}

fn properties() -> Arc<WriterProperties> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        // Measured numbers hardly ever repeat.
        .set_dictionary_enabled(false)
        .set_created_by("trueness".into());
    Arc::new(properties.build())
}

struct Table {
    writer: SerializedFileWriter<AtomicFile>,
    layout: Layout,
}

impl PointsSink for Table {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        for start in (0..block.points.len()).step_by(MAX_ROWS_PER_GROUP) {
            let end = block.points.len().min(start + MAX_ROWS_PER_GROUP);
            let of = |there: bool| if there { start..end } else { 0..0 };
            let part = Block {
                points: &block.points[start..end],
                deviation: &block.deviation[of(self.layout.deviation)],
                reason: &block.reason[of(self.layout.reason)],
                face: &[],
                color: &block.color[of(self.layout.color)],
            };
            self.group(&part).map_err(fault)?;
        }
        Ok(())
    }
    fn finish(self: Box<Self>) -> Result<AtomicFile, WriteFault> {
        self.writer.into_inner().map_err(fault)
    }
}

impl Table {
    fn group(&mut self, block: &Block) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for axis in 0..3 {
            let values: Vec<f64> = block.points.iter().map(|p| p[axis]).collect();
            doubles(&mut group, &values, None)?;
        }
        if self.layout.deviation {
            let levels: Vec<i16> = block.deviation.iter().map(|d| i16::from(!d.is_nan())).collect();
            let values: Vec<f64> = block.deviation.iter().copied().filter(|d| !d.is_nan()).collect();
            doubles(&mut group, &values, Some(&levels))?;
        }
        if self.layout.reason {
            bytes(&mut group, block.reason.iter().copied())?;
        }
        if self.layout.color {
            for channel in 0..3 {
                bytes(&mut group, block.color.iter().map(|c| c[channel]))?;
            }
        }
        group.close()?;
        Ok(())
    }
}

fn bytes(
    group: &mut SerializedRowGroupWriter<'_, AtomicFile>,
    values: impl Iterator<Item = u8>,
) -> Result<(), ParquetError> {
    let values: Vec<i32> = values.map(i32::from).collect();
    if let Some(mut column) = group.next_column()? {
        column.typed::<Int32Type>().write_batch(&values, None, None)?;
        column.close()?;
    }
    Ok(())
}

fn doubles(
    group: &mut SerializedRowGroupWriter<'_, AtomicFile>,
    values: &[f64],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<DoubleType>().write_batch(values, levels, None)?;
        column.close()?;
    }
    Ok(())
}

/// Writes points with a column of each of their numbers, null where there is none, and of the number of the reason.
pub(crate) fn values<const N: usize>(
    file: AtomicFile,
    points: &[Point],
    values: &Values<N>,
) -> Result<AtomicFile, WriteFault> {
    let table = || -> Result<AtomicFile, ParquetError> {
        let mut columns = vec![];
        for name in ["x", "y", "z"] {
            columns.push(column(name, Physical::DOUBLE, Repetition::REQUIRED)?);
        }
        for name in values.names {
            columns.push(column(name, Physical::DOUBLE, Repetition::OPTIONAL)?);
        }
        columns.push(column("reason", Physical::INT32, Repetition::REQUIRED)?);
        let schema = Type::group_type_builder("points").with_fields(columns).build()?;
        let mut writer = SerializedFileWriter::new(file, Arc::new(schema), properties())?;
        for start in (0..points.len()).step_by(MAX_ROWS_PER_GROUP) {
            let rows = start..points.len().min(start + MAX_ROWS_PER_GROUP);
            let mut group = writer.next_row_group()?;
            for axis in 0..3 {
                let own: Vec<f64> = points[rows.clone()].iter().map(|p| p[axis]).collect();
                doubles(&mut group, &own, None)?;
            }
            for k in 0..N {
                let all: Vec<f64> = rows.clone().map(|i| (values.of)(i)[k]).collect();
                let levels: Vec<i16> = all.iter().map(|x| i16::from(x.is_finite())).collect();
                let own: Vec<f64> = all.into_iter().filter(|x| x.is_finite()).collect();
                doubles(&mut group, &own, Some(&levels))?;
            }
            bytes(&mut group, rows.map(|i| (values.reason)(i)))?;
            group.close()?;
        }
        writer.into_inner()
    };
    table().map_err(fault)
}
