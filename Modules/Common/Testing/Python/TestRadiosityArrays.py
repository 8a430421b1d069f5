"""The names of the arrays are there from Python, each once."""
import lambert

cell = ["Reflectance", "Emittance", "FaceFlags", "SurfaceId", "MaterialId", "PartId", "SourceCellId", "InputFaceId",
        "Side", "ClusterId", "LeafId"]
point = ["Irradiance", "Radiosity", "IrradianceVector", "StandardError", "GeometricNormals"]
for name in cell + point:
    assert getattr(lambert.vtkRadiosityArrays, name)() == name
tables = {"Material": ["Name", "Reflectance", "Emittance", "TwoSidedEmitter"],
          "Part": ["Name", "Source", "MeshId", "ObjectToWorld"],
          "Light": ["Name", "Type", "Position", "Direction", "Intensity", "ConeAngles"],
          "Camera": ["Position", "FocalPoint", "ViewUp", "ViewAngle"]}
for table, columns in tables.items():
    for column in columns:
        assert getattr(lambert.vtkRadiosityArrays, table + column)() == table + "." + column
assert lambert.vtkRadiosityArrays().GetClassName() == "vtkRadiosityArrays"
