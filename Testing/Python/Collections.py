"""What the tests of .vtpc files share: VTK's own reader, and data as they compare."""
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader


def pieces_of(name):
    """Names and poly data, as VTK's own reader gives them; the name is None where there is none."""
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(name)
    reader.Update()
    collection = reader.GetOutput()
    names, pieces = [], []
    for i in range(collection.GetNumberOfPartitionedDataSets()):
        assert collection.GetNumberOfPartitions(i) == 1, i
        has_name = collection.HasMetaData(i) and collection.GetMetaData(i).Has(vtkCompositeDataSet.NAME())
        names.append(collection.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) if has_name else None)
        pieces.append(collection.GetPartition(i, 0))
    return names, pieces


def values(array):
    if array.IsA("vtkStringArray"):
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]
    return vtk_to_numpy(array)


def arrays_of(data):
    """Arrays of points, cells or fields by their names."""
    return {data.GetAbstractArray(i).GetName(): values(data.GetAbstractArray(i)) for i in range(data.GetNumberOfArrays())}


def corners_of(mesh):
    """Numbers of the points of each triangle."""
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
