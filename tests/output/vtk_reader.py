"""An XDMF file as ParaView reads it, without a display. Importing this raises ImportError where VTK has no XDMF
reader."""

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader


def opened(path):
    """The reader, and what it complains of from now on: GetOutput() is None or empty while there is nothing."""
    complaints = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(complaints)
    reader = vtkXdmfReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    return reader, complaints


def grids(reader, time=None):
    """Grids by name; those of one time of several, if given."""
    if time is None:
        reader.Update()
    else:
        reader.UpdateTimeStep(time)
    data = reader.GetOutputDataObject(0)
    return {
        data.GetMetaData(i).Get(data.NAME()).split("[")[0]: data.GetBlock(i) for i in range(data.GetNumberOfBlocks())
    }
