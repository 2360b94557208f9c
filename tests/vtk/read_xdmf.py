"""What VTK's reader of XDMF, which ParaView uses, finds in a file, as JSON on stdout: for each time series its
times and, at each, the number of points and cells, the types of the cells, and all values of each array.

    python3 read_xdmf.py case.xdmf
"""
import json
import sys

try:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
except ImportError as missing:
    sys.exit(f"{missing}: this test needs VTK's Python with its reader of XDMF, as ParaView's pvpython has it; "
             "Debian 12's python3-vtk9 is built without")


def arrays_of(data):
    found = {}
    for i in range(data.GetNumberOfArrays()):
        values = data.GetArray(i)
        found[values.GetName()] = [list(values.GetTuple(k)) for k in range(values.GetNumberOfTuples())]
    return found


def described(grid):
    return {
        "points": [list(grid.GetPoint(i)) for i in range(grid.GetNumberOfPoints())],
        "cell_types": sorted({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}),
        "cells": grid.GetNumberOfCells(),
        "cell_data": arrays_of(grid.GetCellData()),
        "point_data": arrays_of(grid.GetPointData()),
    }


reader = vtkXdmfReader()
reader.SetFileName(sys.argv[1])
reader.UpdateInformation()
key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
times = reader.GetOutputInformation(0).Get(key)
steps = []
for time in times or []:
    reader.UpdateTimeStep(time)
    output = reader.GetOutputDataObject(0)
    grids = {}
    if output.IsA("vtkMultiBlockDataSet"):
        for i in range(output.GetNumberOfBlocks()):
            block = output.GetBlock(i)
            name = output.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) if output.HasMetaData(i) else str(i)
            if block is not None and block.GetNumberOfCells() > 0:
                grids[name] = described(block)
    else:
        grids["only"] = described(output)
    steps.append({"time": time, "grids": grids})
json.dump(steps, sys.stdout)
