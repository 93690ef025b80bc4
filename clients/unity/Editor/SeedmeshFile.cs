using System;
using System.IO;
using System.Linq;
using System.Text;
using UnityEngine;

namespace Seedmesh.Editor
{
    /// <summary>Reads what the service wrote into the extras of a model, which glTFast does not show.</summary>
    public static class SeedmeshFile
    {
        [Serializable] class Document { public Node[] nodes = new Node[0]; }
        [Serializable] class Node { public Extras extras = new Extras(); }
        [Serializable] class Extras { public Levels levels = new Levels(); }
        [Serializable] class Levels { public Level[] list = new Level[0]; }
        [Serializable] class Level { public float screen = 0; }

        /// <summary>Shares of the screen's height below which the coarser levels of a GLB file begin, falling; empty: it has one level.</summary>
        public static float[] HeightsOf(string path)
        {
            const int header = 20; // of the file and of its first chunk, which is JSON
            var bytes = File.ReadAllBytes(path);
            if (bytes.Length < header) return new float[0];
            var json = Encoding.UTF8.GetString(bytes, header, Math.Min(BitConverter.ToInt32(bytes, 12), bytes.Length - header));
            var lists = JsonUtility.FromJson<Document>(json).nodes.Select(node => node.extras.levels.list).Where(list => list.Length > 1);
            return lists.Take(1).SelectMany(list => list.Skip(1)).Select(level => level.screen).ToArray();
        }
    }
}
