"""The table of a cohort: table.csv for people and programs, table.h5 with the same columns and their types."""

import csv
import os

import h5py
import numpy


def columns_of(found):
    """Every column that a case has, in the order in which they came."""
    return list(dict.fromkeys(column for one in found for column in one["row"]))


def write_csv(found, path):
    part = f"{path}.{os.getpid()}.part"
    with open(part, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns_of(found), restval="")
        writer.writeheader()
        writer.writerows(one["row"] for one in found)
    os.replace(part, path)


def dataset_name(column, group):
    """A slash would make a group of it, and "." is the group itself."""
    name = column.replace("/", "|") if column.strip(".") else f"column {column}"
    while name in group:
        name += "|"
    return name


def is_number(values):
    known = [value for value in values if value is not None]
    return bool(known) and all(isinstance(value, (int, float)) for value in known)


def write_hdf5(found, path):
    """One dataset for each column, in the order of the cases: numbers as float64, NaN where there is none; else UTF-8.
    The attribute "columns" of the group has their names in order, "datasets" where each stands.
    /orders/METHOD/CASE: Strahler orders from the terminals up, how many branches each has."""
    part = f"{path}.{os.getpid()}.part"
    with h5py.File(part, "w") as file:
        file.attrs["schema"] = "pneuma/cohort-table/1"
        table = file.create_group("table")
        names = {}
        for column in columns_of(found):
            values = [one["row"].get(column) for one in found]
            name = names[column] = dataset_name(column, table)
            if is_number(values):
                table[name] = numpy.array([numpy.nan if value is None else value for value in values], dtype="f8")
            else:
                texts = ["" if value is None else str(value) for value in values]
                table.create_dataset(name, data=texts, dtype=h5py.string_dtype())
        table.attrs.create("columns", list(names), dtype=h5py.string_dtype())
        table.attrs.create("datasets", list(names.values()), dtype=h5py.string_dtype())
        for one in found:
            for method, measures in one["measures"].items():
                counts = measures.get("morphometry", {}).get("strahler", {}).get("counts")
                if counts:
                    file[f"orders/{method}/{one['row']['case']}"] = numpy.array(counts, dtype="i8")
    os.replace(part, path)
