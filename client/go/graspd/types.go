// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Made by generate.py from lcmtypes/, where every member's meaning and unit is.

package graspd

// Control is control_t.
type Control struct {
	Utime   int64  `json:"utime"`
	Id      int64  `json:"id"`
	Command int8   `json:"command"`
	Text    string `json:"text"`
}

// Values of members.
const (
	ControlReload = 0
	ControlSet    = 1
	ControlUndo   = 2
	ControlReset  = 3
)

func (*Control) fingerprint() uint64 { return 0x1a187596f91f8882 }

// DepthImage is depth_image_t.
type DepthImage struct {
	Utime      int64   `json:"utime"`
	Seq        int64   `json:"seq"`
	FrameName  string  `json:"frame_name"`
	DepthScale float64 `json:"depth_scale"`
	Fx         float64 `json:"fx"`
	Fy         float64 `json:"fy"`
	Cx         float64 `json:"cx"`
	Cy         float64 `json:"cy"`
	Width      int32   `json:"width"`
	Height     int32   `json:"height"`
	DataSize   int32   `json:"data_size"`
	Data       []uint8 `json:"data" count:"DataSize"`
}

func (*DepthImage) fingerprint() uint64 { return 0xa92f072e49028cde }

// ErrorReport is error_report_t.
type ErrorReport struct {
	Utime int64  `json:"utime"`
	Event string `json:"event"`
	Text  string `json:"text"`
	Count int64  `json:"count"`
}

func (*ErrorReport) fingerprint() uint64 { return 0x09b8ceb71f819382 }

// Gripper is gripper_t.
type Gripper struct {
	Name            string  `json:"name"`
	Aperture        float64 `json:"aperture"`
	FingerWidth     float64 `json:"finger_width"`
	FingerThickness float64 `json:"finger_thickness"`
	FingerLength    float64 `json:"finger_length"`
	GraspDepth      float64 `json:"grasp_depth"`
	MinGap          float64 `json:"min_gap"`
}

func (*Gripper) fingerprint() uint64 { return 0x6c886dc464ef9e2b }

// HandleList is handle_list_t.
type HandleList struct {
	Utime                int64         `json:"utime"`
	Seq                  int64         `json:"seq"`
	SourceChannel        string        `json:"source_channel"`
	FrameName            string        `json:"frame_name"`
	Gripper              Gripper       `json:"gripper"`
	Status               int8          `json:"status"`
	StatusText           string        `json:"status_text"`
	ConfigRevision       int64         `json:"config_revision"`
	VoxelSize            float64       `json:"voxel_size"`
	Degraded             int8          `json:"degraded"`
	PointsIn             int32         `json:"points_in"`
	PointsUsed           int32         `json:"points_used"`
	NumSegments          int32         `json:"num_segments"`
	NumCandidates        int32         `json:"num_candidates"`
	NumCandidateFailures int32         `json:"num_candidate_failures"`
	CandidateFailures    []ReasonCount `json:"candidate_failures" count:"NumCandidateFailures"`
	NumSegmentFailures   int32         `json:"num_segment_failures"`
	SegmentFailures      []ReasonCount `json:"segment_failures" count:"NumSegmentFailures"`
	NumStages            int32         `json:"num_stages"`
	Stages               []StageTime   `json:"stages" count:"NumStages"`
	Latency              float64       `json:"latency"`
	NumHandles           int32         `json:"num_handles"`
	Handles              []Handle      `json:"handles" count:"NumHandles"`
}

// Values of members.
const (
	HandleListOk                 = 0
	HandleListEmptyCloud         = 1
	HandleListNoFinitePoints     = 2
	HandleListNothingInWorkspace = 3
	HandleListNoHandles          = 4
	HandleListRefused            = 5
	HandleListOverloaded         = 6
	HandleListFailed             = 7
)

func (*HandleList) fingerprint() uint64 { return 0x9bf98642e84fd318 }

// Handle is handle_t.
type Handle struct {
	Id           int32      `json:"id"`
	SegmentId    int32      `json:"segment_id"`
	Position     [3]float64 `json:"position"`
	Orientation  [4]float64 `json:"orientation"`
	Rpy          [3]float64 `json:"rpy"`
	Approach     [3]float64 `json:"approach"`
	ClosingAxis  [3]float64 `json:"closing_axis"`
	MajorAxis    [3]float64 `json:"major_axis"`
	Width        float64    `json:"width"`
	Gap          [2]float64 `json:"gap"`
	ObservedFree [2]float64 `json:"observed_free"`
	NumPoints    int32      `json:"num_points"`
	Score        float64    `json:"score"`
}

func (*Handle) fingerprint() uint64 { return 0x74b325a96dccaf93 }

// PointCloud is point_cloud_t.
type PointCloud struct {
	Utime     int64        `json:"utime"`
	Seq       int64        `json:"seq"`
	FrameName string       `json:"frame_name"`
	Viewpoint [3]float64   `json:"viewpoint"`
	Width     int32        `json:"width"`
	Height    int32        `json:"height"`
	NumFields int32        `json:"num_fields"`
	Fields    []PointField `json:"fields" count:"NumFields"`
	PointStep int32        `json:"point_step"`
	DataSize  int32        `json:"data_size"`
	Data      []uint8      `json:"data" count:"DataSize"`
}

func (*PointCloud) fingerprint() uint64 { return 0x19d75af77ba18842 }

// PointField is point_field_t.
type PointField struct {
	Name     string `json:"name"`
	Offset   int32  `json:"offset"`
	Datatype int8   `json:"datatype"`
	Count    int32  `json:"count"`
}

// Values of members.
const (
	PointFieldInt8    = 1
	PointFieldUint8   = 2
	PointFieldInt16   = 3
	PointFieldUint16  = 4
	PointFieldInt32   = 5
	PointFieldUint32  = 6
	PointFieldFloat32 = 7
	PointFieldFloat64 = 8
)

func (*PointField) fingerprint() uint64 { return 0xb24e10825e0b476d }

// ReasonCount is reason_count_t.
type ReasonCount struct {
	Reason string `json:"reason"`
	Count  int64  `json:"count"`
}

func (*ReasonCount) fingerprint() uint64 { return 0xf9575f78a99ffa69 }

// Sealed is sealed_t.
type Sealed struct {
	KeyId       int64     `json:"key_id"`
	Sender      int64     `json:"sender"`
	Seq         int64     `json:"seq"`
	Utime       int64     `json:"utime"`
	PayloadSize int32     `json:"payload_size"`
	Payload     []uint8   `json:"payload" count:"PayloadSize"`
	Mac         [32]uint8 `json:"mac"`
}

func (*Sealed) fingerprint() uint64 { return 0xa70cb71154832893 }

// Segment is segment_t.
type Segment struct {
	Id            int32         `json:"id"`
	Object        int32         `json:"object"`
	NumPoints     int32         `json:"num_points"`
	Centroid      [3]float64    `json:"centroid"`
	Normal        [3]float64    `json:"normal"`
	MajorAxis     [3]float64    `json:"major_axis"`
	NumCandidates int32         `json:"num_candidates"`
	NumHandles    int32         `json:"num_handles"`
	Reason        string        `json:"reason"`
	NumFailures   int32         `json:"num_failures"`
	Failures      []ReasonCount `json:"failures" count:"NumFailures"`
}

func (*Segment) fingerprint() uint64 { return 0xbd79eb009d90a4cf }

// SegmentationRequest is segmentation_request_t.
type SegmentationRequest struct {
	Utime         int64   `json:"utime"`
	SourceChannel string  `json:"source_channel"`
	Seconds       float64 `json:"seconds"`
}

func (*SegmentationRequest) fingerprint() uint64 { return 0x59367a3b2c1bd887 }

// Segmentation is segmentation_t.
type Segmentation struct {
	Utime          int64      `json:"utime"`
	Seq            int64      `json:"seq"`
	SourceChannel  string     `json:"source_channel"`
	FrameName      string     `json:"frame_name"`
	ConfigRevision int64      `json:"config_revision"`
	VoxelSize      float64    `json:"voxel_size"`
	Origin         [3]float64 `json:"origin"`
	Step           float64    `json:"step"`
	NumPoints      int32      `json:"num_points"`
	DataSize       int32      `json:"data_size"`
	Data           []uint8    `json:"data" count:"DataSize"`
	SupportPlane   [4]float64 `json:"support_plane"`
	NumSegments    int32      `json:"num_segments"`
	Segments       []Segment  `json:"segments" count:"NumSegments"`
}

// Values of members.
const (
	SegmentationPointBytes = 10
	SegmentationNoSegment  = 65535
	SegmentationEdge       = 1
	SegmentationSupport    = 2
)

func (*Segmentation) fingerprint() uint64 { return 0xbb512cf7d3d00ed5 }

// SourceStatus is source_status_t.
type SourceStatus struct {
	Name        string        `json:"name"`
	Channel     string        `json:"channel"`
	Received    int64         `json:"received"`
	Processed   int64         `json:"processed"`
	Failed      int64         `json:"failed"`
	Coarse      int64         `json:"coarse"`
	Dropped     int64         `json:"dropped"`
	Refused     int64         `json:"refused"`
	Pending     int64         `json:"pending"`
	Lost        int64         `json:"lost"`
	Rate        float64       `json:"rate"`
	Age         float64       `json:"age"`
	LatencyP50  float64       `json:"latency_p50"`
	LatencyP99  float64       `json:"latency_p99"`
	Degraded    int8          `json:"degraded"`
	NumDrops    int32         `json:"num_drops"`
	Drops       []ReasonCount `json:"drops" count:"NumDrops"`
	NumRefusals int32         `json:"num_refusals"`
	Refusals    []ReasonCount `json:"refusals" count:"NumRefusals"`
	LastError   string        `json:"last_error"`
}

func (*SourceStatus) fingerprint() uint64 { return 0x689f959761da91b7 }

// StageTime is stage_time_t.
type StageTime struct {
	Stage        string  `json:"stage"`
	Milliseconds float64 `json:"milliseconds"`
}

func (*StageTime) fingerprint() uint64 { return 0x40a5983447503faf }

// Status is status_t.
type Status struct {
	Utime            int64          `json:"utime"`
	Version          string         `json:"version"`
	Host             string         `json:"host"`
	Pid              int32          `json:"pid"`
	State            int8           `json:"state"`
	Uptime           float64        `json:"uptime"`
	Cpu              float64        `json:"cpu"`
	Rss              int64          `json:"rss"`
	PeakRss          int64          `json:"peak_rss"`
	NumThreads       int32          `json:"num_threads"`
	NumDescriptors   int32          `json:"num_descriptors"`
	NumWorkers       int32          `json:"num_workers"`
	NumStuck         int32          `json:"num_stuck"`
	WaitingBytes     int64          `json:"waiting_bytes"`
	ReceiveErrors    int64          `json:"receive_errors"`
	ReassemblyErrors int64          `json:"reassembly_errors"`
	Reconnects       int64          `json:"reconnects"`
	LogLost          int64          `json:"log_lost"`
	Ignored          int64          `json:"ignored"`
	ConfigRevision   int64          `json:"config_revision"`
	ConfigError      string         `json:"config_error"`
	ControlId        int64          `json:"control_id"`
	Overrides        string         `json:"overrides"`
	NumErrors        int32          `json:"num_errors"`
	Errors           []ErrorReport  `json:"errors" count:"NumErrors"`
	NumSources       int32          `json:"num_sources"`
	Sources          []SourceStatus `json:"sources" count:"NumSources"`
}

// Values of members.
const (
	StatusRunning  = 0
	StatusStopping = 1
	StatusStuck    = 2
)

func (*Status) fingerprint() uint64 { return 0x3e93e45b223e4491 }
