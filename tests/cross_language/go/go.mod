module golden

go 1.19

require graspd v0.0.0

replace graspd => ../../../client/go
