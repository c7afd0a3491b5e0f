# VTK's dual depth peeling on a mesh drawn several times over: times of frames, and the picture's own word on how many layers it blended.
# Called by `copeel bench`: vtk_peeling.py JOB.json RESULT.json
import json
import math
import sys
import time

import vtk

job = json.load(open(sys.argv[1]))
renderer = vtk.vtkRenderer()
renderer.SetBackground(0, 0, 0)
renderer.UseDepthPeelingOn()
renderer.SetMaximumNumberOfPeels(1000)
renderer.SetOcclusionRatio(0)

reader = vtk.vtkOBJReader()
reader.SetFileName(job["mesh"])
reader.Update()
for _ in range(job["copies"]):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(reader.GetOutput())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(1, 1, 1)
    look.SetOpacity(job["alpha"])
    look.LightingOff()
    actor.ForceTranslucentOn()
    renderer.AddActor(actor)

camera = renderer.GetActiveCamera()
camera.SetPosition(*job["eye"])
camera.SetFocalPoint(*[e + f for e, f in zip(job["eye"], job["forward"])])
camera.SetViewUp(*job["up"])
camera.SetViewAngle(job["degrees"])
renderer.ResetCameraClippingRange()

window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetAlphaBitPlanes(1)
window.SetSize(job["width"], job["height"])
window.AddRenderer(renderer)
window.Render()

milliseconds = []
while len(milliseconds) < job["frames"] or sum(milliseconds) < job["enough_ms"]:
    start = time.perf_counter()
    window.Render()
    window.WaitForCompletion()
    milliseconds.append(1000 * (time.perf_counter() - start))

grab = vtk.vtkWindowToImageFilter()
grab.SetInput(window)
grab.ReadFrontBufferOff()
grab.Update()
scalars = grab.GetOutput().GetPointData().GetScalars()
red = bytes(memoryview(scalars))[::scalars.GetNumberOfComponents()]   # numpy need not be there
layers = sum(round(math.log(1 - int(v) / 255) / math.log(1 - job["alpha"])) for v in red if 0 < v < 255)
result = {"ms": milliseconds, "layers": layers, "version": vtk.vtkVersion().GetVTKVersion(), "dual": renderer.GetLastRenderingUsedDepthPeeling()}
json.dump(result, open(sys.argv[2], "w"))
