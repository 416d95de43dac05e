"""Poses as 4 by 4 matrices."""
import numpy as np


def moved(pose, points):
    return points @ pose[:3, :3].T + pose[:3, 3]


def pose_of(rotation, shift):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, shift
    return pose
