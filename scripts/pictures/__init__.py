"""Pictures of a Railwave results file: what scripts/picture is made of."""
