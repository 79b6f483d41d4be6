module examples

go 1.19

require graspd v0.0.0

replace graspd => ../../go
