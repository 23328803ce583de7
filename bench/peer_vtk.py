"""One volume that only absorbs, by VTK's ray caster on the CPU, for `brume bench --peers`: peer_vtk.py WORK.json.
Casts once to prepare, then as often as asked; writes what gets through of each pixel and prints the seconds of each."""
import ctypes
import json
import re
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

OPACITIES = 4097  # of the transfer function, between which it is linear

with open(sys.argv[1], encoding="utf-8") as file:
    work = json.load(file)

size = [int(n) for n in work["size"]]
density = np.fromfile(work["densities"], dtype=np.float32)
image = vtk.vtkImageData()
image.SetDimensions(size)
lo, hi = np.array(work["lo"]), np.array(work["hi"])
voxel = (hi - lo) / size
image.SetOrigin(lo + 0.5 * voxel)  # a sample stands in the middle of its voxel
image.SetSpacing(voxel)
image.GetPointData().SetScalars(numpy_to_vtk(density))

# Opacity of one step: of a density that is the same along it.
step = float(voxel[0] * work["step_voxels"])
sigma_t = work["sigma_a"][0] + work["sigma_s"][0]
opacity = vtk.vtkPiecewiseFunction()
for value in np.linspace(0, density.max(), OPACITIES):
    opacity.AddPoint(value, -np.expm1(-sigma_t * value * step))
black = vtk.vtkColorTransferFunction()
black.AddRGBPoint(0, 0, 0, 0)
look = vtk.vtkVolumeProperty()
look.SetScalarOpacity(opacity)
look.SetScalarOpacityUnitDistance(step)
look.SetColor(black)
look.SetInterpolationTypeToLinear()
look.ShadeOff()
look.DisableGradientOpacityOn()

caster = vtk.vtkFixedPointVolumeRayCastMapper()
caster.SetInputData(image)
caster.SetBlendModeToComposite()
caster.SetAutoAdjustSampleDistances(0)
caster.SetSampleDistance(step)
caster.SetInteractiveSampleDistance(step)
caster.SetImageSampleDistance(1)
caster.IntermixIntersectingGeometryOff()
caster.SetNumberOfThreads(work["threads"])
volume = vtk.vtkVolume()
volume.SetMapper(caster)
volume.SetProperty(look)

renderer = vtk.vtkRenderer()
window = vtk.vtkRenderWindow()  # never opened: the caster takes its size
window.SetOffScreenRendering(1)
width, height = work["film"]
window.SetSize(width, height)
window.AddRenderer(renderer)
renderer.AddVolume(volume)
camera = renderer.GetActiveCamera()
camera.SetPosition(work["eye"])
camera.SetFocalPoint(work["target"])
camera.SetViewUp(work["up"])
camera.SetViewAngle(work["vfov"])
renderer.ResetCameraClippingRange()


def cast():
    begin = time.perf_counter()
    caster.PerImageInitialization(renderer, volume, 0, [0.0] * 3, [0.0] * 3, [0] * 6)
    caster.PerVolumeInitialization(renderer, volume)
    caster.PerSubVolumeInitialization(renderer, volume, 0)
    caster.RenderSubVolume()
    return time.perf_counter() - begin


cast()
seconds = [cast() for _ in range(work["runs"])]

# What it drew: four numbers of 15 bits each of a part of the window, from its lowest row up.
drawn = caster.GetRayCastImage()
columns, rows = drawn.GetImageInUseSize()
stride, tall = drawn.GetImageMemorySize()
first_column, first_row = drawn.GetImageOrigin()
address = int(re.search("[0-9a-f]{8,}", drawn.GetImage()).group(), 16)
numbers = np.ctypeslib.as_array((ctypes.c_ushort * (4 * stride * tall)).from_address(address))
alpha = numbers.reshape(tall, stride, 4)[:rows, :columns, 3] / 32767
through = np.ones((height, width), np.float32)
through[first_row:first_row + rows, first_column:first_column + columns] -= alpha
np.repeat(through[::-1].astype(np.float32), 3).tofile(work["picture"])
print(*seconds)
