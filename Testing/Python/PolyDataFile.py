"""What tests of .vtp files share: VTK's own reader."""
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def mesh_of(name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()
