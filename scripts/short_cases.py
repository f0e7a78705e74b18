"""The cases on meshes so coarse, or for times so short, that all of them run in minutes on two processors."""

WHEEL_AND_RAIL = [
    f"meshes.{mesh}.{key}" for mesh in ("wheel", "rail") for key in ("zone_size=0.005", "zone_layers=1")
]
# As the comment of cases/joint.toml has it.
COARSE_JOINT = [
    "meshes.wheel.zone_size=0.005", "meshes.wheel.zone_start=-0.03", "meshes.wheel.zone_length=0.15",
    "meshes.wheel.path_start=-0.03", "meshes.wheel.path_length=0.16", "meshes.wheel.path_size=0.005",
    "meshes.wheel.coarse_size=0.05", "meshes.wheel.section_size=0.012", "meshes.wheel.zone_layers=1",
    "parts.wheel.position=[-0.04,-0.00815,0.62]", "points.sprung_mass.position=[-0.04,0,0.62]",
    "tracks.track.start=-2.1", "tracks.track.end=2.1", "tracks.track.zone_size=0.006", "tracks.track.zone_layers=1",
    "tracks.track.zone_start=-0.07", "tracks.track.zone_end=0.07", "tracks.track.path_start=-0.07",
    "tracks.track.path_end=0.07", "tracks.track.path_size=0.006", "tracks.track.section_size=0.012",
    "tracks.track.coarse_size=0.05", "tracks.track.core_size=0.06", "time.end=2.9e-3", "output.field_interval=1e-4",
]
CASES = {
    "first steps": ("cases/first_steps.toml", []),
    "rolling": ("cases/rolling.toml", [*WHEEL_AND_RAIL, "time.end=2e-3"]),
    "torque ramp": ("cases/torque_ramp.toml", ["time.end=3e-3"]),
    "track": ("cases/track.toml", []),
    "wheelset": ("cases/wheelset.toml", ["time.end=1e-3"]),
    "squeal": ("cases/squeal.toml", ["time.end=1e-3"]),
    "joint": ("cases/joint.toml", COARSE_JOINT),
    "whole track": ("cases/whole_track.toml", ["time.end=2e-3"]),
    "hammer on the track": ("cases/hammer_track.toml", ["time.end=2e-3"]),
    "hammer on the joint": ("cases/hammer_joint.toml", ["time.end=2e-3"]),
    "calibration": ("cases/calibrate_track.toml", []),
    "wheel modes": ("cases/wheel_modes.toml", ["time.end=2e-3"]),
    "surface pulse": ("cases/surface_pulse.toml", []),
    "Hertz, sphere": ("cases/verify/hertz_sphere.toml", []),
    "Hertz, ellipse": ("cases/verify/hertz_ellipse.toml", []),
    "Cattaneo": ("cases/verify/cattaneo.toml", []),
    "Taylor's bar": ("cases/verify/taylor_bar.toml", []),
}
